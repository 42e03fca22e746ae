use serde::{Deserialize, Serialize};

use crate::replay::forward_gap::{ForwardGap, ForwardWindow};
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
        let at = |window: &&ForwardWindow| (window.window_s - window_s).abs() < 1e-9;
        let window = gap.windows.iter().find(at)?;
        Some(Self { before: window.nominal.tip_rms_m?, after: window.extended.tip_rms_m? })
    }

    /// Tracking error of the origin of the last link (m).
    pub fn of_tracking(errors: &[TrackedError]) -> Option<Self> {
        Self::of(|name| errors.iter().find(|run| run.model == name)?.tip_rms_m)
    }

    fn of(error: impl Fn(&str) -> Option<f64>) -> Option<Self> {
        let [before, after] = COMPARED.map(error);
        Some(Self { before: before?, after: after? })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    use crate::replay::forward_gap::Drift;

    /// Torque before is the root of 436, after 5; drift and tracking of the tip are 5 and 1.
    #[test]
    fn a_gain_is_that_of_all_joints_and_of_the_tip() {
        let torque = |model: &str, rms_nm: [f64; 2]| TorqueError {
            model: model.to_owned(),
            rms_nm: rms_nm.to_vec(),
            nmse: vec![None; 2],
        };
        let tracking = |model: &str, tip: f64| TrackedError {
            model: model.to_owned(),
            rms: None,
            tip_rms_m: Some(tip),
            feedback_share: vec![0.0; 2],
        };
        let drift = |tip: f64| Drift { tip_rms_m: Some(tip), ..Drift::default() };
        let window = |window_s: f64, scale: f64| ForwardWindow {
            window_s,
            windows: 1,
            nominal: drift(5.0 * scale),
            extended: drift(1.0),
        };
        let gap = ForwardGap { windows: vec![window(0.05, 7.0), window(0.2, 1.0)] };
        let torque = [torque("named", [3.0, 4.0]), torque("cad", [6.0, 20.0])];
        let tracking = [tracking("cad", 5.0), tracking("named", 1.0)];
        let times = |gain: Option<PredictionGain>| gain.unwrap().times();
        let of_torque = times(PredictionGain::of_torque(&torque));
        assert!((of_torque - 436.0_f64.sqrt() / 5.0).abs() < 1e-12, "{of_torque}");
        assert!((times(PredictionGain::of_drift(&gap, 0.2)) - 5.0).abs() < 1e-12);
        assert!((times(PredictionGain::of_tracking(&tracking)) - 5.0).abs() < 1e-12);
        assert_eq!(PredictionGain::of_drift(&gap, 0.1), None);
        assert_eq!(PredictionGain::of_torque(&torque[..1]), None);
    }
}
