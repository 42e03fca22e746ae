use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use tracking::{End, JointMetrics};

use crate::tracking::tracked_run::TrackedRun;

/// Tracking error with one feedforward.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct TrackedError {
    /// Name of the feedforward.
    pub model: String,
    /// RMS error by joint (rad or m), of the link where its position is known. `None` for a run that stopped early.
    pub rms: Option<Vec<f64>>,
    /// RMS distance of the origin of the last link from its reference (m). `None` for a run that stopped early.
    pub tip_rms_m: Option<f64>,
    /// RMS of the feedback over that of the command, by joint.
    pub feedback_share: Vec<f64>,
}

impl TrackedError {
    /// The errors of a run.
    pub fn of(run: &TrackedRun) -> Self {
        let metrics = &run.metrics;
        let is_whole = run.tracking.end == End::Complete;
        let rmse = |joint: &JointMetrics| joint.link.map_or(joint.rmse, |link| link.rmse);
        let tip = metrics.end_effector_of_links.unwrap_or(metrics.end_effector);
        Self {
            model: run.kind.name().to_owned(),
            rms: is_whole.then(|| metrics.joints.iter().map(rmse).collect()),
            tip_rms_m: is_whole.then_some(tip.rms_m),
            feedback_share: metrics.joints.iter().map(|joint| joint.feedback_share).collect(),
        }
    }
}
