use experiment::stored;
use serde::{Deserialize, Serialize};

use crate::panel::answers::HeldOut;

/// Torque errors on a held-out log, relative to the torque of the trial.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Prediction {
    /// Of the robot as described.
    pub nominal: Option<RelativeError>,
    /// Of the robot with the findings.
    pub extended: Option<RelativeError>,
    /// Of plain least squares.
    pub least_squares: Option<RelativeError>,
    /// Of the fit of the two questions.
    pub two_questions: Option<RelativeError>,
}

/// Torque errors over the RMS of the effort of their joints.
///
/// ```text
/// joints_j = RMS(error_j while j moves) / RMS(effort_j),   all = sqrt(mean over j of joints_j^2)
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RelativeError {
    /// By joint; `None` for a joint without effort or motion.
    pub joints: Vec<Option<f64>>,
    /// Over all joints.
    #[serde(deserialize_with = "stored::number")]
    pub all: f64,
}

impl Prediction {
    /// Share of the nominal error by which an extended robot may exceed it without counting as worse.
    pub const MARGIN: f64 = 0.01;

    pub(super) fn new(held_out: &HeldOut, torque_rms: &[f64]) -> Self {
        let of = |errors: &Option<Vec<Option<f64>>>| {
            errors.as_ref().and_then(|errors| RelativeError::new(errors, torque_rms))
        };
        Self {
            nominal: of(&held_out.nominal),
            extended: of(&held_out.extended),
            least_squares: of(&held_out.least_squares),
            two_questions: of(&held_out.two_questions),
        }
    }

    /// Whether the findings make the prediction worse by more than [`MARGIN`](Self::MARGIN), where both
    /// errors were measured.
    pub fn worse(&self) -> Option<bool> {
        Some(self.ratio(self.extended.as_ref())? > 1.0 + Self::MARGIN)
    }

    /// An error over that of the robot as described; infinite where the prediction is NaN.
    pub fn ratio(&self, of: Option<&RelativeError>) -> Option<f64> {
        let nominal = self.nominal.as_ref()?.all;
        let usable = nominal.is_finite() && nominal > 0.0;
        let ratio = of?.all / nominal;
        usable.then_some(if ratio.is_finite() { ratio } else { f64::INFINITY })
    }
}

impl RelativeError {
    /// `None` where no joint has an effort and moves.
    fn new(errors: &[Option<f64>], torque_rms: &[f64]) -> Option<Self> {
        let relative = |(error, rms): (&Option<f64>, &f64)| {
            error.filter(|_| rms.is_finite() && *rms > 0.0).map(|error| error / rms)
        };
        let joints: Vec<Option<f64>> = errors.iter().zip(torque_rms).map(relative).collect();
        let squares: Vec<f64> = joints.iter().flatten().map(|error| error * error).collect();
        let all = (squares.iter().sum::<f64>() / squares.len() as f64).sqrt();
        (!squares.is_empty()).then_some(Self { joints, all })
    }
}
