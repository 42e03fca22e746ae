use logs::LogError;
use motion::MotionError;

/// Why no motion can be searched.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum NextMotionError {
    /// A motion cannot be made.
    #[error(transparent)]
    Motion(#[from] MotionError),
    /// Signals cannot be low-passed.
    #[error(transparent)]
    Log(#[from] LogError),
    /// There is no pair to tell apart and no cause to determine.
    #[error("no goal was given, a pair of rivals or a cause to determine was expected")]
    NoGoal,
    /// No run was given.
    #[error("no log was given, at least one run was expected: rivals are sized by it")]
    NoRuns,
    /// A run, or the noise, does not have the joints of the robot.
    #[error("{what} has {found} joints, the robot has {expected}")]
    WrongJoints {
        /// The run, or the noise.
        what: String,
        /// Joints found.
        found: usize,
        /// Joints expected.
        expected: usize,
    },
    /// A setting is out of its range.
    #[error("{name}: found {found}, {expected} was expected")]
    Setting {
        /// The number.
        name: &'static str,
        /// The value found.
        found: f64,
        /// What was expected.
        expected: &'static str,
    },
    /// Every motion that was tried needs more effort than a joint has.
    #[error(
        "no motion was found that keeps to the effort limits of the robot: the gentlest needs \
         {share:.1} times what is allowed"
    )]
    TooHeavy {
        /// Largest effort of the gentlest motion over what is allowed.
        share: f64,
    },
}
