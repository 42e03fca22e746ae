use schemars::{JsonSchema, Schema};
use serde::{Serialize, Serializer};

use pages::{FileHash, Provenance, ReportError, with_schema, written_schema};

/// Name and version of the schema of `learning.json`.
const SCHEMA: &str = "plumbline.learning/1";

/// Models of the torque side by side: how far off they are on logs that took no part, how
/// sure they are of it, what they cost.
///
/// Every list by joint has the order of `joints`.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct LearningComparison {
    /// Name of the robot.
    pub robot: String,
    /// The joints.
    pub joints: Vec<ComparedJoint>,
    /// What the Gaussian processes learned from.
    pub train: DataSet,
    /// What the parameters of the rigid bodies come from.
    pub regression: DataSet,
    /// What the errors were measured on.
    pub test: DataSet,
    /// How samples were chosen where not all were used, in words.
    pub thinning: String,
    /// Cut-off of the low-pass filter of all signals (Hz).
    pub cutoff_hz: f64,
    /// The models, in the order of tables and figures.
    pub models: Vec<ModelRow>,
    /// What to know of the data before trusting the numbers.
    pub warnings: Vec<String>,
    /// Where it all comes from; the logs stand with the data.
    pub provenance: Provenance,
}

/// A joint of the robot.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, JsonSchema)]
pub struct ComparedJoint {
    /// Its name.
    pub name: String,
    /// Unit of its effort: `N m` or `N`.
    pub effort_unit: &'static str,
}

impl ComparedJoint {
    /// The joints of a robot, in its order.
    pub fn all(robot: &robot::Robot) -> Vec<Self> {
        let joint = |link: &robot::Link| Self {
            name: link.joint.name.clone(),
            effort_unit: if link.joint.kind.is_rotation() { "N m" } else { "N" },
        };
        robot.links().iter().map(joint).collect()
    }
}

/// The samples of some logs.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, JsonSchema)]
pub struct DataSet {
    /// The files.
    pub logs: Vec<FileHash>,
    /// Samples in them.
    pub rows: usize,
    /// Samples that were used.
    pub points: usize,
}

/// What became of one model.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct ModelRow {
    /// Its short name, such as `gp-rbd`.
    pub name: String,
    /// What it is, in a few words.
    pub words: String,
    /// Training points, or inducing points, that a prediction visits.
    pub points: usize,
    /// Mean square error over the variance of the effort, by joint.
    pub nmse: Vec<f64>,
    /// Root of the mean square error (N m or N), by joint.
    pub rmse_nm: Vec<f64>,
    /// Share of the test samples within their 95 % interval, by joint; none for a model
    /// that gives no variance.
    pub coverage_95: Option<Vec<f64>>,
    /// Log marginal likelihood of the training samples, all joints; none for a model without one.
    pub log_likelihood: Option<f64>,
    /// Time that the training took, for all joints (s).
    pub training_s: f64,
    /// Median time of the prediction for one state, all joints (us).
    pub prediction_us: f64,
    /// Hyperparameters, by joint; none for a model without a kernel.
    pub kernels: Option<Vec<KernelRow>>,
    /// What to know of this model, in sentences.
    pub remarks: Vec<String>,
}

/// Hyperparameters of one joint, and the search that found them.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct KernelRow {
    /// Variance of the function ((N m)² or N²).
    pub signal_variance_nm2: f64,
    /// Length scale of every input, by its name, in the unit of the input.
    #[serde(serialize_with = "by_name")]
    #[schemars(with = "std::collections::BTreeMap<String, f64>")]
    pub length_scales: Vec<(String, f64)>,
    /// Variance of the noise ((N m)² or N²).
    pub noise_variance_nm2: f64,
    /// Log marginal likelihood of the joint alone; none where the joints share parameters.
    pub log_likelihood: Option<f64>,
    /// How the search ended, in words.
    pub search: String,
    /// Evaluations of the likelihood.
    pub evaluations: usize,
    /// Weight of the Gaussian kernel beside the rigid bodies' kernel (eq. 9 of Nguyen-Tuong &
    /// Peters 2010); none for other models.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub lambda: Option<f64>,
    /// Names of the hyperparameters that ended at a bound of the search.
    pub at_bounds: Vec<String>,
    /// What was added to the diagonal for the matrix to be positive definite ((N m)² or N²).
    pub jitter_nm2: f64,
}

fn by_name<S: Serializer>(scales: &[(String, f64)], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_map(scales.iter().map(|(name, scale)| (name, scale)))
}

impl LearningComparison {
    /// The JSON schema of the file.
    pub fn schema() -> Schema {
        written_schema::<Self>(SCHEMA, "Plumbline comparison of learned models")
    }

    /// `learning.json`, in the schema `plumbline.learning/1`. A number that is not finite is
    /// `null`.
    ///
    /// # Errors
    ///
    /// [`ReportError::Format`].
    pub fn json(&self) -> Result<String, ReportError> {
        with_schema(SCHEMA, self)
    }
}

#[cfg(test)]
mod tests {
    use crate::learning::sample;

    #[test]
    fn length_scales_stand_under_their_names_and_what_a_model_has_not_is_null() {
        let text = sample::comparison().json().unwrap();
        let value: serde_json::Value = serde_json::from_str(&text).unwrap();
        assert_eq!(value["schema"], "plumbline.learning/1");
        assert_eq!(value["train"]["logs"][0]["sha256"].as_str().unwrap().len(), 64);
        let [rigid, process] = [&value["models"][0], &value["models"][1]];
        assert!(rigid["kernels"].is_null() && rigid["log_likelihood"].is_null());
        assert!(rigid["nmse"][1].is_null(), "not a number");
        assert_eq!(process["kernels"][1]["length_scales"]["shoulder.position (rad)"], 1.25);
        assert!(process["kernels"][0].get("lambda").is_none());
    }
}
