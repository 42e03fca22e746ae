use experiment::{Learned, PAPER_MODELS, PROCESSES};
use learner::{ModelKind, Samples, TorqueScore};
use logs::Prepared;
use serde::{Deserialize, Serialize};

/// What came of figure 2: the errors of every model, data by data.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct LearningErrors {
    /// Name of the robot.
    pub robot: String,
    /// Names of the joints, in the order of all that is told joint by joint.
    pub joints: Vec<String>,
    /// Samples that a Gaussian process learned from.
    pub points: usize,
    /// Samples that the errors are measured on, of each data.
    pub test_points: usize,
    /// On the data that rigid bodies describe.
    pub simulated: Vec<ModelErrors>,
    /// On the data that they do not.
    pub real: Vec<ModelErrors>,
    /// Of the models of the real data, on a motion outside what they were learned from.
    pub outside: Vec<ModelErrors>,
}

/// How well a model predicts torques that it was not learned from.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ModelErrors {
    /// Name of the model.
    pub model: String,
    /// Mean square error over the variance of the torque, by joint; none where that is constant.
    pub nmse: Vec<Option<f64>>,
    /// Root mean square error, by joint (N m or N).
    pub rmse_nm: Vec<f64>,
}

impl ModelErrors {
    /// The errors of [`PAPER_MODELS`] on at most so many samples, spread evenly.
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
    /// How many times the error of the named effects the least error of a Gaussian process is,
    /// outside what was learned from, at a joint.
    pub fn outside_gain(&self, joint: usize) -> Option<f64> {
        let of = |kind: ModelKind| {
            let errors = self.outside.iter().find(|errors| errors.model == kind.name())?;
            errors.nmse.get(joint).copied().flatten()
        };
        let least = PROCESSES.into_iter().filter_map(of).min_by(f64::total_cmp)?;
        Some(least / of(ModelKind::Named)?)
    }
}
