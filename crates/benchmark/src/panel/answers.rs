use diagnosis::{Diagnosis, EffectAt};
use serde::{Deserialize, Serialize};

/// The answers of the diagnosis and of two baselines to the logs of one trial.
#[derive(Debug, Clone, PartialEq)]
pub struct Answers {
    /// The diagnosis; in words why it refuses the logs.
    pub diagnosis: Result<Diagnosis, String>,
    /// How well each predicts the torque of a log that it has not seen.
    pub held_out: HeldOut,
    /// Effects that the two questions name.
    pub two_questions: Vec<EffectAt>,
    /// Effects that plain least squares names.
    pub least_squares: Vec<EffectAt>,
    /// What it cost.
    pub costs: Costs,
}

/// RMS error of predicted torque on a held-out log (N m or N), by joint in the order of the sheet,
/// while the joint moves. None where it could not be measured.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct HeldOut {
    /// Of the robot as described.
    pub nominal: Option<Vec<Option<f64>>>,
    /// Of the robot with the findings.
    pub extended: Option<Vec<Option<f64>>>,
    /// Of plain least squares.
    pub least_squares: Option<Vec<Option<f64>>>,
    /// Of what the two questions fit.
    pub two_questions: Option<Vec<Option<f64>>>,
}

/// What a trial cost, in seconds by the wall clock.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Costs {
    /// Making its logs; 0 where a store had them.
    pub logs_s: f64,
    /// The diagnosis.
    pub diagnosis_s: f64,
    /// Plain least squares.
    pub least_squares_s: f64,
    /// The two questions.
    pub two_questions_s: f64,
    /// Largest memory of the process while it diagnosed (MB).
    pub peak_memory_mb: Option<f64>,
}
