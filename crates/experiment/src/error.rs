use std::path::PathBuf;

use diagnosis::DiagnosisError;
use document::DocumentError;
use learner::{LearnerError, ModelKind};
use logs::LogError;
use recording::RecordingError;
use robot::RobotError;
use simulator::SimulatorError;
use tracking::TrackingError;

/// Why a scenario cannot be run.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ExperimentError {
    /// A scenario has a value that cannot be used.
    #[error(transparent)]
    Document(#[from] DocumentError),
    /// The robot cannot be used.
    #[error(transparent)]
    Robot(#[from] RobotError),
    /// The arm cannot be simulated.
    #[error(transparent)]
    Simulator(#[from] SimulatorError),
    /// A log cannot be used or written.
    #[error(transparent)]
    Log(#[from] LogError),
    /// A model cannot be learned or read.
    #[error(transparent)]
    Learner(#[from] LearnerError),
    /// The named effects cannot be found.
    #[error(transparent)]
    Diagnosis(#[from] DiagnosisError),
    /// The arm cannot be tracked.
    #[error(transparent)]
    Tracking(#[from] TrackingError),
    /// The recording cannot be written.
    #[error(transparent)]
    Recording(#[from] RecordingError),
    /// The thread that writes a run has ended early.
    #[error("{}: the thread that wrote it died, what it had written is there", path.display())]
    WriterDied {
        /// The recording.
        path: PathBuf,
    },
    /// A model is to be learned without any data.
    #[error("{}: the scenario feeds {model} forward, but learn.train names no run to learn it from", path.display())]
    NothingToLearnFrom {
        /// The scenario of the plant, which has the runs.
        path: PathBuf,
        /// The model.
        model: ModelKind,
    },
    /// A folder lacks a model.
    #[error("{}: there is no such file, the scenario feeds {model} forward", path.display())]
    NoModel {
        /// The file that was expected.
        path: PathBuf,
        /// The model.
        model: ModelKind,
    },
    /// The truth about a trial cannot be read.
    #[error("{}: it does not tell what was put in: {reason}", path.display())]
    UnreadableTruth {
        /// The file.
        path: PathBuf,
        /// What the operating system or the decoder said.
        reason: String,
    },
    /// A robot has no gains for tracking.
    #[error("{}: it has no set of gains, one [gains.NAME] at least was expected: the motion is tracked with the softest", path.display())]
    NoGains {
        /// The robot's file.
        path: PathBuf,
    },
    /// A stage of a run can be neither read nor written.
    #[error("{}: {reason}, a file of a run was expected that can be read and written", path.display())]
    Stage {
        /// The file.
        path: PathBuf,
        /// What the operating system said.
        reason: String,
    },
}
