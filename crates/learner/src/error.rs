use dynamics::DynamicsError;
use gaussian_process::GpError;

/// Input that no model can be learned from or asked with.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum LearnerError {
    /// There are no samples.
    #[error("there are no samples to learn from")]
    NoSamples,
    /// A log has another number of joints than the robot.
    #[error("the samples are of {got} joints, the robot has {expected}")]
    WrongJoints {
        /// Joints of the robot.
        expected: usize,
        /// Joints of the samples.
        got: usize,
    },
    /// The dynamics refused its input.
    #[error(transparent)]
    Dynamics(#[from] DynamicsError),
    /// The Gaussian process refused its input.
    #[error(transparent)]
    GaussianProcess(#[from] GpError),
}
