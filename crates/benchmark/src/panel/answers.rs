use diagnosis::{Diagnosis, EffectAt};
use serde::{Deserialize, Serialize};

/// The answers of the diagnosis and of plain least squares to the logs of one trial.
#[derive(Debug, Clone, PartialEq)]
pub struct Answers {
    /// The diagnosis, or in words why it rejects the logs.
    pub diagnosis: Result<Diagnosis, String>,
    /// Torque errors of all models on a held-out log.
    pub held_out: HeldOut,
    /// Effects that plain least squares names.
    pub least_squares: Vec<EffectAt>,
    /// Times and memory.
    pub costs: Costs,
}

/// RMS torque error on a held-out log (N m or N) while the joint moves, by joint in the order of the sheet; `None`
/// where it could not be measured.
///
/// All models are measured on the samples of one log, so that their errors are pairs.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct HeldOut {
    /// Of the robot as described.
    pub nominal: Option<Vec<Option<f64>>>,
    /// Of the robot with the findings.
    pub extended: Option<Vec<Option<f64>>>,
    /// Of plain least squares.
    pub least_squares: Option<Vec<Option<f64>>>,
}

/// Wall-clock times (s) and memory of a trial.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Costs {
    /// Making its logs; 0 where a store had them already.
    pub logs_s: f64,
    /// The diagnosis.
    pub diagnosis_s: f64,
    /// Plain least squares.
    pub least_squares_s: f64,
    /// Peak memory of the process during the diagnosis (MB).
    pub peak_memory_mb: Option<f64>,
}
