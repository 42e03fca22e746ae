use experiment::stored;
use serde::{Deserialize, Serialize};

use crate::panel::answers::HeldOut;
use crate::statistics::rate::Fraction;

/// Torque errors on a held-out log, relative to the torque of the trial.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Prediction {
    /// Of the robot as described.
    pub nominal: Option<RelativeError>,
    /// Of the robot with the findings.
    pub extended: Option<RelativeError>,
    /// Of plain least squares.
    pub least_squares: Option<RelativeError>,
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

    /// The same of the error of plain least squares.
    pub const BY_HAND_MARGIN: f64 = 0.02;

    pub(super) fn new(held_out: &HeldOut, torque_rms: &[f64]) -> Self {
        let of = |errors: &Option<Vec<Option<f64>>>| {
            errors.as_ref().and_then(|errors| RelativeError::new(errors, torque_rms))
        };
        Self {
            nominal: of(&held_out.nominal),
            extended: of(&held_out.extended),
            least_squares: of(&held_out.least_squares),
        }
    }

    /// Whether the findings make the prediction worse by more than [`MARGIN`](Self::MARGIN), where both
    /// errors were measured.
    pub fn worse(&self) -> Option<bool> {
        Some(exceeds(self.extended.as_ref()?.all, self.nominal.as_ref()?.usable()?, Self::MARGIN))
    }

    /// Share of the joints at which they do.
    pub fn worse_joints(&self) -> Fraction {
        self.joints_beyond(self.nominal.as_ref(), Self::MARGIN)
    }

    /// Whether the error of the extended robot exceeds that of plain least squares by more than
    /// [`BY_HAND_MARGIN`](Self::BY_HAND_MARGIN), where both were measured.
    pub fn worse_than_by_hand(&self) -> Option<bool> {
        let by_hand = self.least_squares.as_ref()?.usable()?;
        Some(exceeds(self.extended.as_ref()?.all, by_hand, Self::BY_HAND_MARGIN))
    }

    /// Share of the joints at which it does.
    pub fn joints_worse_than_by_hand(&self) -> Fraction {
        self.joints_beyond(self.least_squares.as_ref(), Self::BY_HAND_MARGIN)
    }

    /// An error over that of the robot as described; infinite where the prediction is NaN.
    pub fn ratio(&self, of: Option<&RelativeError>) -> Option<f64> {
        ratio(of, self.nominal.as_ref())
    }

    /// The error of the extended robot over that of plain least squares; infinite where the prediction is NaN.
    pub fn by_hand_ratio(&self) -> Option<f64> {
        ratio(self.extended.as_ref(), self.least_squares.as_ref())
    }

    fn joints_beyond(&self, limit: Option<&RelativeError>, margin: f64) -> Fraction {
        let joints = |error: Option<&RelativeError>| {
            error.map_or_else(Vec::new, |error| error.joints.clone())
        };
        let pairs = joints(self.extended.as_ref()).into_iter().zip(joints(limit));
        let beyond = pairs.filter_map(|(error, limit)| Some(exceeds(error?, limit?, margin)));
        Fraction::of(beyond.map(|beyond| (beyond, 1.0)))
    }
}

/// Whether an error exceeds another by more than a share of it. What is no number does.
fn exceeds(error: f64, other: f64, margin: f64) -> bool {
    error.is_nan() || error > (1.0 + margin) * other
}

fn ratio(of: Option<&RelativeError>, over: Option<&RelativeError>) -> Option<f64> {
    let ratio = of?.all / over?.usable()?;
    Some(if ratio.is_finite() { ratio } else { f64::INFINITY })
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

    /// The error over all joints, where something can be compared with it.
    fn usable(&self) -> Option<f64> {
        (self.all.is_finite() && self.all > 0.0).then_some(self.all)
    }
}
