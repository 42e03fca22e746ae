use logs::{LogError, of_run};

/// Why a diagnosis cannot be made.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum DiagnosisError {
    /// A log cannot be used.
    #[error(transparent)]
    Log(#[from] LogError),
    /// No run was given.
    #[error("no log was given, at least one run was expected")]
    NoRuns,
    /// A run does not have the joints of the robot.
    #[error("{of_run}: it has {got} joints, the robot has {expected}", of_run = of_run(run))]
    WrongJoints {
        /// Name of the run.
        run: String,
        /// Joints found.
        got: usize,
        /// Joints expected.
        expected: usize,
    },
    /// A run is compared with itself.
    #[error(
        "{of_run}: it is among the logs before and after, two sets without a run in common were expected", of_run = of_run(run))]
    InBoth {
        /// Name of the run.
        run: String,
    },
    /// All runs together are too short.
    #[error(
        "the logs hold {got} independent stretches, at least {expected} were expected: record a longer motion or give more runs"
    )]
    TooShort {
        /// Blocks found.
        got: usize,
        /// Blocks expected.
        expected: usize,
    },
    /// A setting is out of its range.
    #[error("{name}: found {value}, expected {expected}")]
    Setting {
        /// The setting.
        name: &'static str,
        /// The value found.
        value: f64,
        /// What was expected.
        expected: &'static str,
    },
}
