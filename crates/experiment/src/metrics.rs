use serde::Serialize;

use crate::claims::claim::Claim;
use crate::replay::forward_gap::ForwardGap;
use crate::scoring::score::Score;
use crate::torque::torque_error::TorqueError;
use crate::tracking::tracked_error::TrackedError;

/// Results of an [`Experiment`](crate::Experiment): the injected effects and the findings, and what
/// the findings gain on held-out runs.
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
