use std::path::PathBuf;

use diagnosis::DiagnosisError;
use document::DocumentError;
use learner::{LearnerError, ModelKind};
use logs::LogError;
use population::PopulationError;
use recording::RecordingError;
use robot::RobotError;
use simulator::SimulatorError;
use tracking::TrackingError;

/// Why a scenario cannot be run.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum EvaluationError {
    /// The scenario cannot be meant.
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
    /// A trial of a population cannot be made.
    #[error(transparent)]
    Population(Box<PopulationError>),
    /// The arm cannot be tracked.
    #[error(transparent)]
    Tracking(#[from] TrackingError),
    /// The recording cannot be written.
    #[error(transparent)]
    Recording(#[from] RecordingError),
    /// The thread that writes a run has died.
    #[error("{}: the thread that wrote it died, what it had written is there", path.display())]
    WriterDied {
        /// The recording.
        path: PathBuf,
    },
    /// A model is to be learned and there is nothing to learn from.
    #[error("{}: the scenario feeds {model} forward, but learn.train names no run to learn it from", path.display())]
    NothingToLearnFrom {
        /// The scenario of the plant, whose runs there are.
        path: PathBuf,
        /// The model.
        model: ModelKind,
    },
    /// A folder of models lacks one.
    #[error("{}: there is no such file, the scenario feeds {model} forward", path.display())]
    NoModel {
        /// Where it was looked for.
        path: PathBuf,
        /// The model.
        model: ModelKind,
    },
    /// The folder of a trial can be neither made nor read.
    #[error("{}: it cannot be the folder of a trial: {reason}", path.display())]
    TrialFolder {
        /// The folder.
        path: PathBuf,
        /// What the operating system said.
        reason: String,
    },
    /// A trial has nothing to diagnose.
    #[error("{}: there is no log in it, a trial needs one *.parquet at least", path.display())]
    NoLogs {
        /// The folder.
        path: PathBuf,
    },
    /// A folder holds no campaign.
    #[error(
        "{}: no campaign was planned here: plumbline trials plan CAMPAIGN.toml --out {} plans one",
        path.display(), path.display()
    )]
    NoCampaign {
        /// The folder.
        path: PathBuf,
    },
    /// A trial cannot be scored.
    #[error("{}: it does not tell what was put in: {reason}", path.display())]
    UnreadableTruth {
        /// The file.
        path: PathBuf,
        /// What the operating system or the decoder said.
        reason: String,
    },
    /// A folder holds trials of another campaign.
    #[error(
        "{}: it is of another campaign ({}, this one is {}), an empty folder was expected",
        path.display(), short(found), short(planned)
    )]
    OtherCampaign {
        /// A shard of it.
        path: PathBuf,
        /// The campaign that it is of, by its hash.
        found: String,
        /// The campaign that was to be planned.
        planned: String,
    },
    /// A table of trials is none.
    #[error("{}: {reason}, trials.parquet of a campaign was expected", path.display())]
    UnreadableTrials {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        reason: String,
    },
    /// A table holds trials of another campaign.
    #[error(
        "{}: its trials are of another campaign ({}), those of this one ({}) were expected",
        path.display(), short(found), short(planned)
    )]
    OtherTrials {
        /// The file.
        path: PathBuf,
        /// The campaign that they are of, by its hash.
        found: String,
        /// The campaign that was planned.
        planned: String,
    },
    /// Two results have no trial in common.
    #[error("{} and {}: they have no trial in common, two results of the same trials were expected", first.display(), second.display())]
    NoCommonTrials {
        /// The first.
        first: PathBuf,
        /// The second.
        second: PathBuf,
    },
    /// A campaign keeps no logs in a store.
    #[error("{}: a store holds logs of populations, this campaign starts from a scenario, whose logs --keep keeps", path.display())]
    NoStore {
        /// The store.
        path: PathBuf,
    },
    /// A robot has no gains to be tracked with.
    #[error("{}: it has no set of gains, one [gains.NAME] at least was expected: the motion is tracked with the softest", path.display())]
    NoGains {
        /// The robot's file.
        path: PathBuf,
    },
    /// A stage of a run can be neither kept nor made.
    #[error("{}: {reason}, a file of a run was expected that can be read and written", path.display())]
    Stage {
        /// The file.
        path: PathBuf,
        /// What the operating system said.
        reason: String,
    },
    /// The threads of a worker cannot be started.
    #[error("the threads of a worker cannot be started: {reason}")]
    NoThreads {
        /// What the operating system said.
        reason: String,
    },
}

/// The start of a hash, enough to tell it from others by eye.
fn short(hash: &str) -> &str {
    hash.get(..8).unwrap_or(hash)
}

impl From<PopulationError> for EvaluationError {
    fn from(error: PopulationError) -> Self {
        Self::Population(Box::new(error))
    }
}
