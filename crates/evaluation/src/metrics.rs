use serde::Serialize;

use crate::{Claim, ForwardGap, Score, TorqueError, TrackedError};

/// What came of an [`Experiment`](crate::Experiment): what was put in and found, and what finding
/// it gains on runs that took no part in it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Metrics {
    /// Name of the robot.
    pub robot: String,
    /// Names of the joints, in the order of all that is told joint by joint.
    pub joints: Vec<String>,
    /// What was put in, and what was found.
    pub score: Score,
    /// The runs that causes were found in.
    pub learned: Vec<String>,
    /// The runs that torque and drift are of.
    pub test: Vec<String>,
    /// Errors of the torque: of the robot as described, the extended one, and learned models.
    pub torque: Vec<TorqueError>,
    /// Drift of the simulation, of the robot as described and the extended one.
    pub forward: ForwardGap,
    /// Name of the gains of the tracking.
    pub gains: String,
    /// Errors of the tracking, by what is fed forward.
    pub tracking: Vec<TrackedError>,
    /// What is claimed of the tracking, judged; nothing where not all of the models were fed
    /// forward that the claims are about.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub claims: Vec<Claim>,
}

/// The error of the robot as described beside that of the extended one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Gain {
    /// As described.
    pub before: f64,
    /// Extended.
    pub after: f64,
}

impl Gain {
    /// How many times less the error is.
    pub fn times(&self) -> f64 {
        self.before / self.after
    }
}

impl Metrics {
    /// Root of the sum over the joints of the squared RMS errors of the torque (N m), which joints
    /// that slide add theirs to in N.
    pub fn torque_gain(&self) -> Option<Gain> {
        let of = |name: &str| {
            let model = self.torque.iter().find(|model| model.model == name)?;
            Some(model.rms_nm.iter().map(|rms| rms * rms).sum::<f64>().sqrt())
        };
        Some(Gain { before: of("cad")?, after: of("named")? })
    }

    /// Drift of the origin of the last link after a length of time (m).
    pub fn drift_gain(&self, window_s: f64) -> Option<Gain> {
        let at = |window: &&crate::ForwardWindow| (window.window_s - window_s).abs() < 1e-9;
        let window = self.forward.windows.iter().find(at)?;
        let (before, after) = (window.nominal.tip_rms_m?, window.extended.tip_rms_m?);
        Some(Gain { before, after })
    }

    /// Tracking error of the origin of the last link (m).
    pub fn tracking_gain(&self) -> Option<Gain> {
        let of = |name: &str| self.tracking.iter().find(|run| run.model == name)?.tip_rms_m;
        Some(Gain { before: of("cad")?, after: of("named")? })
    }
}
