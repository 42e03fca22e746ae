use dynamics::DynamicsError;
use gaussian_process::GpError;

/// Input that no model can be learned from or evaluated at.
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
    /// A sample is not finite or too large.
    #[error("{signal} of joint {joint} in sample {sample} is {value}, which no sensor reports")]
    BadSample {
        /// Name of the signal.
        signal: &'static str,
        /// Index of the sample in what was given.
        sample: usize,
        /// Index of the joint.
        joint: usize,
        /// The value found.
        value: f64,
    },
    /// A setting is out of its range.
    #[error("{name}: {found} was found, {expected} expected")]
    Setting {
        /// The setting.
        name: &'static str,
        /// Its value.
        found: String,
        /// What it should be.
        expected: &'static str,
    },
    /// A model needs something that was not given.
    #[error("{model} needs {what}")]
    Missing {
        /// Name of the model.
        model: &'static str,
        /// What it needs.
        what: &'static str,
    },
    /// There is not memory enough.
    #[error(
        "{points} points need {needed_gb:.1} GB of memory, {available_gb:.1} GB are free: \
         {fitting} points would fit"
    )]
    Memory {
        /// Points asked for.
        points: usize,
        /// Memory they need (GB).
        needed_gb: f64,
        /// Memory that is free (GB).
        available_gb: f64,
        /// Points that would fit.
        fitting: usize,
    },
    /// A file does not hold a model that can be used.
    #[error("{}: not a model that can be used: {reason}", path.display())]
    NotAModel {
        /// The file.
        path: std::path::PathBuf,
        /// What is wrong with it.
        reason: String,
    },
    /// A file does not hold samples that can be learned from.
    #[error("{}: not samples that can be learned from: {reason}", path.display())]
    NotSamples {
        /// The file.
        path: std::path::PathBuf,
        /// What is wrong with it.
        reason: String,
    },
    /// A saved model is one of another robot.
    #[error(
        "{}: this is a model of {found} (joints {found_joints}), whose joints, axes or origins \
         are not those of {expected}", path.display()
    )]
    OtherRobot {
        /// The file.
        path: std::path::PathBuf,
        /// The robot that it is a model of.
        found: String,
        /// That robot's joints.
        found_joints: String,
        /// The robot that was given.
        expected: String,
    },
    /// A log or file was refused.
    #[error(transparent)]
    Log(#[from] logs::LogError),
    /// The dynamics refused its input.
    #[error(transparent)]
    Dynamics(#[from] DynamicsError),
    /// The Gaussian process refused its input.
    #[error(transparent)]
    GaussianProcess(#[from] GpError),
}
