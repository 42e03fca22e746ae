use pages::{Provenance, ReportError, with_schema, written_schema};
use schemars::{JsonSchema, Schema};
use serde::Serialize;

/// Name and version of the schema of `replay.json`.
const SCHEMA: &str = "plumbline.replay/1";

/// How far a simulation is from recorded motion and torque.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct ReplayReport {
    /// Name of the robot.
    pub robot: String,
    /// Names of the joints; every list by joint has this order.
    pub joints: Vec<String>,
    /// The runs.
    pub runs: Vec<ReplayedRun>,
    /// What was done to the clocks of the logs, in sentences.
    pub warnings: Vec<String>,
    /// Where it all comes from.
    pub provenance: Provenance,
}

/// What was simulated of one run.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct ReplayedRun {
    /// Its name.
    pub name: String,
    /// Drift under the measured torque, by length of time.
    pub windows: Vec<ReplayedWindow>,
    /// The torque along the measured motion; none for a robot without gains.
    pub torque: Option<ReplayedTorque>,
    /// Windows that were left out and why, in sentences.
    pub remarks: Vec<String>,
}

/// Drift of a simulation that the measured torque moves for some time.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct ReplayedWindow {
    /// How long (ms).
    pub window_ms: f64,
    /// Simulated minus measured position at the end, RMS over all such windows, by joint (rad or
    /// m); none where every window ran away.
    pub drift_rms: Option<Vec<f64>>,
    /// Distance of the simulated from the measured tip, the origin of the last link, at the end, RMS over all such
    /// windows (m); none where every window ran away.
    pub tip_rms_m: Option<f64>,
}

/// Torque of a simulation that follows the measured motion.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct ReplayedTorque {
    /// Simulated minus measured, RMS, by joint (N m or N).
    pub error_rms_nm: Vec<f64>,
    /// The measured one, RMS, by joint (N m or N).
    pub measured_rms_nm: Vec<f64>,
}

impl ReplayReport {
    /// The JSON schema of the file.
    pub fn schema() -> Schema {
        written_schema::<Self>(SCHEMA, "Plumbline replay")
    }

    /// `replay.json`, in the schema `plumbline.replay/1`. A number that is not finite is `null`.
    ///
    /// # Errors
    ///
    /// [`ReportError::Format`].
    pub fn json(&self) -> Result<String, ReportError> {
        with_schema(SCHEMA, self)
    }
}
