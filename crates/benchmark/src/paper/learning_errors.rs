use experiment::{Learned, PAPER_MODELS, PROCESSES};
use learner::{ModelKind, Samples, TorqueScore};
use logs::Prepared;
use serde::{Deserialize, Serialize};

/// The results of figure 2: the errors of every model on each data set.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct LearningErrors {
    /// Name of the robot.
    pub robot: String,
    /// Names of the joints, in the order of all values by joint.
    pub joints: Vec<String>,
    /// Number of samples for a Gaussian process.
    pub points: usize,
    /// Number of samples for the errors on each data set.
    pub test_points: usize,
    /// Errors on the data that rigid bodies describe.
    pub simulated: Vec<ModelErrors>,
    /// Errors on the data that rigid bodies do not describe.
    pub real: Vec<ModelErrors>,
    /// Errors of the models of the real data, on a motion outside their training data.
    pub outside: Vec<ModelErrors>,
}

/// Errors of a model on held-out torques.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ModelErrors {
    /// Name of the model.
    pub model: String,
    /// Mean square error over the variance of the torque, by joint; `None` where the torque is constant.
    pub nmse: Vec<Option<f64>>,
    /// Root mean square error, by joint (N m or N).
    pub rmse_nm: Vec<f64>,
}

impl ModelErrors {
    /// The errors of [`PAPER_MODELS`] on at most `points` samples, spread evenly.
    pub(super) fn of(models: &Learned, test: &Prepared, points: usize) -> Vec<Self> {
        let samples = Samples::new(test).thin(points);
        let known = PAPER_MODELS.into_iter().filter_map(|kind| models.model(kind));
        let errors = known.map(|model| {
            let TorqueScore { nmse, rmse, .. } = TorqueScore::of(model, &samples);
            let nmse = nmse.into_iter().map(|nmse| nmse.is_finite().then_some(nmse));
            Self { model: model.kind.name().to_owned(), nmse: nmse.collect(), rmse_nm: rmse }
        });
        errors.collect()
    }
}

impl LearningErrors {
    /// Least error of a Gaussian process over the error of the named effects, outside the training data, at a joint.
    pub fn outside_gain(&self, joint: usize) -> Option<f64> {
        let of = |kind: ModelKind| {
            let errors = self.outside.iter().find(|errors| errors.model == kind.name())?;
            errors.nmse.get(joint).copied().flatten()
        };
        let least = PROCESSES.into_iter().filter_map(of).min_by(f64::total_cmp)?;
        Some(least / of(ModelKind::Named)?)
    }
}
