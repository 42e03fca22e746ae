use serde::{Deserialize, Serialize};

use crate::{ForwardGap, ForwardWindow, TorqueError, TrackedError};

/// Names of the robot as described and of the extended one among models.
const COMPARED: [&str; 2] = ["cad", "named"];

/// The error of the robot as described beside that of the extended one.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Gain {
    /// As described.
    pub before: f64,
    /// Extended.
    pub after: f64,
}

/// What finding the effects of an arm gains on a run that took no part in it; none where an error
/// could not be measured.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Gains {
    /// Torque error, see [`Gain::of_torque`] (N m).
    pub torque: Option<Gain>,
    /// Drift of the simulation, see [`Gain::of_drift`], in [`Gains::WINDOW_S`] (m).
    pub drift: Option<Gain>,
    /// Tracking error, see [`Gain::of_tracking`] (m).
    pub tracking: Option<Gain>,
}

impl Gain {
    /// How many times less the error is.
    pub fn times(&self) -> f64 {
        self.before / self.after
    }

    /// Root of the sum over the joints of the squared RMS errors of the torque (N m), which joints
    /// that slide add theirs to in N.
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
        let (before, after) = (window.nominal.tip_rms_m?, window.extended.tip_rms_m?);
        Some(Self { before, after })
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

impl Gains {
    /// Length of time for which the simulation is rolled forward (s).
    pub const WINDOW_S: f64 = 0.2;

    /// What the errors of an experiment come to.
    pub fn of(torque: &[TorqueError], forward: &ForwardGap, tracking: &[TrackedError]) -> Self {
        Self {
            torque: Gain::of_torque(torque),
            drift: Gain::of_drift(forward, Self::WINDOW_S),
            tracking: Gain::of_tracking(tracking),
        }
    }
}
