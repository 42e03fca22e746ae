use std::path::PathBuf;

use diagnosis::DiagnosisError;
use document::DocumentError;
use exchange::ExchangeError;
use experiment::ExperimentError;
use learner::LearnerError;
use logs::LogError;
use population::PopulationError;
use robot::RobotError;
use simulator::SimulatorError;

/// Why a campaign or a figure cannot be planned, made, compared or drawn.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum BenchmarkError {
    /// An arm cannot be simulated, diagnosed, learned or tracked.
    #[error(transparent)]
    Experiment(Box<ExperimentError>),
    /// A trial of a population cannot be made.
    #[error(transparent)]
    Population(Box<PopulationError>),
    /// The folder of a trial can be neither made nor read.
    #[error("{}: it cannot be the folder of a trial: {reason}", path.display())]
    TrialFolder {
        /// The folder.
        path: PathBuf,
        /// What the operating system said.
        reason: String,
    },
    /// A trial has no logs to diagnose.
    #[error("{}: there is no log in it, a trial needs one *.parquet at least", path.display())]
    NoLogs {
        /// The folder.
        path: PathBuf,
    },
    /// A folder holds no campaign.
    #[error(
        "{}: no campaign was planned here: plumbline-bench plan CAMPAIGN.toml --out {} plans one",
        path.display(), path.display()
    )]
    NoCampaign {
        /// The folder.
        path: PathBuf,
    },
    /// A folder holds trials of another campaign.
    #[error(
        "{}: it is of another campaign ({}, this one is {}), an empty folder was expected",
        path.display(), short(found), short(planned)
    )]
    OtherCampaign {
        /// A shard of the other campaign.
        path: PathBuf,
        /// Hash of the other campaign.
        found: String,
        /// Hash of the campaign that was to be planned.
        planned: String,
    },
    /// A campaign has no population.
    #[error("{}: the campaign of a scenario was found, one of a population was expected", path.display())]
    NoPopulation {
        /// The campaign.
        path: PathBuf,
    },
    /// A table cannot be read as one of trials.
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
        /// Hash of the other campaign.
        found: String,
        /// Hash of the campaign that was planned.
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
    /// A campaign has no sheets of what is true.
    #[error("{}: an account is of a campaign of a population, whose trials have sheets of the truth; this campaign starts from a scenario", path.display())]
    NoTruthSheets {
        /// The folder of the campaign.
        path: PathBuf,
    },
    /// A file of CauseBench cannot be used.
    #[error("{}: {found} was found, {expected} was expected", path.display())]
    UnusableBenchFile {
        /// The file.
        path: PathBuf,
        /// What was found.
        found: String,
        /// What was expected.
        expected: &'static str,
    },
    /// A described arm cannot be written for other programs.
    #[error(transparent)]
    Exchange(#[from] ExchangeError),
    /// The threads of a worker cannot be started.
    #[error("the threads of a worker cannot be started: {reason}")]
    NoThreads {
        /// What the operating system said.
        reason: String,
    },
}

/// The start of a hash, enough for readers to tell it from others.
fn short(hash: &str) -> &str {
    hash.get(..8).unwrap_or(hash)
}

impl From<ExperimentError> for BenchmarkError {
    fn from(error: ExperimentError) -> Self {
        Self::Experiment(Box::new(error))
    }
}

impl From<DocumentError> for BenchmarkError {
    fn from(error: DocumentError) -> Self {
        Self::Experiment(Box::new(error.into()))
    }
}

impl From<RobotError> for BenchmarkError {
    fn from(error: RobotError) -> Self {
        Self::Experiment(Box::new(error.into()))
    }
}

impl From<SimulatorError> for BenchmarkError {
    fn from(error: SimulatorError) -> Self {
        Self::Experiment(Box::new(error.into()))
    }
}

impl From<LogError> for BenchmarkError {
    fn from(error: LogError) -> Self {
        Self::Experiment(Box::new(error.into()))
    }
}

impl From<LearnerError> for BenchmarkError {
    fn from(error: LearnerError) -> Self {
        Self::Experiment(Box::new(error.into()))
    }
}

impl From<DiagnosisError> for BenchmarkError {
    fn from(error: DiagnosisError) -> Self {
        Self::Experiment(Box::new(error.into()))
    }
}

impl From<PopulationError> for BenchmarkError {
    fn from(error: PopulationError) -> Self {
        Self::Population(Box::new(error))
    }
}
