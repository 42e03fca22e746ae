use serde::{Deserialize, Serialize};

use crate::replay::forward_gap::{Drift, ForwardGap, ForwardWindow};
use crate::torque::torque_error::TorqueError;
use crate::tracking::tracked_error::TrackedError;

/// Names of the robot as described and of the extended one among models.
const COMPARED: [&str; 2] = ["cad", "named"];

/// The error of the robot as described, and that of the extended robot.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct PredictionGain {
    /// Error of the robot as described.
    pub before: f64,
    /// Error of the extended robot.
    pub after: f64,
}

/// The gain of finding the effects of an arm, on a run that was held out, at one joint or over all; `None` where an
/// error could not be measured.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Gains {
    /// RMS error of the torque (N m or N).
    pub torque: Option<PredictionGain>,
    /// RMS drift of the simulation after [`Gains::WINDOW_S`] (rad or m).
    pub drift: Option<PredictionGain>,
    /// RMS error of the tracking (rad or m).
    pub tracking: Option<PredictionGain>,
}

impl PredictionGain {
    /// Error before over error after.
    pub fn times(&self) -> f64 {
        self.before / self.after
    }

    /// Root of the sum over the joints of the squared RMS torque errors (N m). Prismatic joints add theirs in N.
    pub fn of_torque(errors: &[TorqueError]) -> Option<Self> {
        Self::of(|name| {
            let model = errors.iter().find(|model| model.model == name)?;
            Some(model.rms_nm.iter().map(|rms| rms * rms).sum::<f64>().sqrt())
        })
    }

    /// Drift of the origin of the last link after a length of time (m).
    pub fn of_drift(gap: &ForwardGap, window_s: f64) -> Option<Self> {
        Self::in_window(gap, window_s, |drift| drift.tip_rms_m)
    }

    /// Tracking error of the origin of the last link (m).
    pub fn of_tracking(errors: &[TrackedError]) -> Option<Self> {
        Self::of(|name| errors.iter().find(|run| run.model == name)?.tip_rms_m)
    }

    fn in_window(
        gap: &ForwardGap,
        window_s: f64,
        rms: impl Fn(&Drift) -> Option<f64>,
    ) -> Option<Self> {
        let at = |window: &&ForwardWindow| (window.window_s - window_s).abs() < 1e-9;
        let window = gap.windows.iter().find(at)?;
        Some(Self { before: rms(&window.nominal)?, after: rms(&window.extended)? })
    }

    fn of(error: impl Fn(&str) -> Option<f64>) -> Option<Self> {
        let [before, after] = COMPARED.map(error);
        Some(Self { before: before?, after: after? })
    }
}

impl Gains {
    /// Length of time for which the simulation is rolled forward (s).
    pub const WINDOW_S: f64 = 0.2;

    /// The gains over all joints. Drift and tracking are those of the origin of the last link.
    pub fn of_all(torque: &[TorqueError], forward: &ForwardGap, tracking: &[TrackedError]) -> Self {
        Self {
            torque: PredictionGain::of_torque(torque),
            drift: PredictionGain::of_drift(forward, Self::WINDOW_S),
            tracking: PredictionGain::of_tracking(tracking),
        }
    }

    /// The gains at joint `j`.
    pub fn at(
        j: usize,
        torque: &[TorqueError],
        forward: &ForwardGap,
        tracking: &[TrackedError],
    ) -> Self {
        let torque_of =
            |name: &str| torque.iter().find(|m| m.model == name)?.rms_nm.get(j).copied();
        let tracking_rms = |name: &str| {
            let run = tracking.iter().find(|run| run.model == name)?;
            run.rms.as_ref()?.get(j).copied()
        };
        let drift = |drift: &Drift| drift.rms.as_ref()?.get(j).copied();
        Self {
            torque: PredictionGain::of(torque_of),
            drift: PredictionGain::in_window(forward, Self::WINDOW_S, drift),
            tracking: PredictionGain::of(tracking_rms),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Before twice as large at the first joint, five times at the second and at the tip.
    #[test]
    fn a_gain_is_that_of_a_joint_or_of_all() {
        let torque = |model: &str, rms_nm: [f64; 2]| TorqueError {
            model: model.to_owned(),
            rms_nm: rms_nm.to_vec(),
            nmse: vec![None; 2],
        };
        let tracking_error = |model: &str, rms: [f64; 2], tip: f64| TrackedError {
            model: model.to_owned(),
            rms: Some(rms.to_vec()),
            tip_rms_m: Some(tip),
            feedback_share: vec![0.0; 2],
        };
        let drift = |rms: [f64; 2], tip: f64| Drift {
            rms: Some(rms.to_vec()),
            tip_rms_m: Some(tip),
            ..Drift::default()
        };
        let window = |window_s: f64, scale: f64| ForwardWindow {
            window_s,
            windows: 1,
            nominal: drift([2.0 * scale, 5.0], 5.0 * scale),
            extended: drift([scale, 1.0], scale),
        };
        let torque = [torque("named", [3.0, 4.0]), torque("cad", [6.0, 20.0])];
        let tracking =
            [tracking_error("cad", [2.0, 5.0], 5.0), tracking_error("named", [1.0, 1.0], 1.0)];
        let forward = ForwardGap { windows: vec![window(0.05, 7.0), window(Gains::WINDOW_S, 1.0)] };
        let times = |gains: Gains| {
            [gains.torque, gains.drift, gains.tracking].map(|gain| gain.unwrap().times())
        };
        let are = |times: &[f64], expected: f64| times.iter().all(|t| (t - expected).abs() < 1e-12);
        assert!(are(&times(Gains::at(0, &torque, &forward, &tracking)), 2.0));
        assert!(are(&times(Gains::at(1, &torque, &forward, &tracking)), 5.0));
        let [all, tip, tip_tracked] = times(Gains::of_all(&torque, &forward, &tracking));
        assert!((all - 436.0_f64.sqrt() / 5.0).abs() < 1e-12, "{all}");
        assert!(are(&[tip, tip_tracked], 5.0), "{tip}, {tip_tracked}");
        let nothing = Gains::at(2, &torque, &forward, &tracking);
        assert_eq!(nothing, Gains { torque: None, drift: None, tracking: None });
    }
}
