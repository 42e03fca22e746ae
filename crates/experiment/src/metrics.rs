use schemars::JsonSchema;
use serde::Serialize;

use crate::claims::claim::Claim;
use crate::replay::forward_gap::ForwardGap;
use crate::scoring::score::Score;
use crate::torque::torque_error::TorqueError;
use crate::tracking::tracked_error::TrackedError;

/// Results of an [`Experiment`](crate::Experiment): the injected effects, the findings, and the gain of the findings
/// on held-out runs.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct Metrics {
    /// Name of the robot.
    pub robot: String,
    /// Names of the joints, in the order of all values by joint.
    pub joints: Vec<String>,
    /// The injected effects and the findings.
    pub score: Score,
    /// The runs in which causes were found.
    pub learned: Vec<String>,
    /// The runs on which torque and drift were measured.
    pub test: Vec<String>,
    /// Torque errors of the robot as described, of the extended robot and of the learned models.
    pub torque: Vec<TorqueError>,
    /// Drift of the simulation of the robot as described and of the extended robot.
    pub forward: ForwardGap,
    /// Name of the set of gains for tracking.
    pub gains: String,
    /// Tracking errors, one entry a feedforward.
    pub tracking: Vec<TrackedError>,
    /// Claims about the tracking, judged. Empty unless all models that the claims compare were fed forward.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub claims: Vec<Claim>,
}
