use std::io;

use benchmark::BenchmarkError;
use cli::{CliError, print_error};
use document::DocumentError;
use experiment::ExperimentError;
use learner::LearnerError;
use logs::LogError;
use report::ReportError;
use robot::RobotError;

use crate::submit_error::SubmitError;

/// Why a command did not run to its end.
#[derive(Debug, thiserror::Error)]
pub enum BenchError {
    /// What plumbline would refuse too: a scenario, a robot, a log, a folder.
    #[error(transparent)]
    Cli(Box<CliError>),
    /// A campaign cannot be planned, made, put together or compared.
    #[error(transparent)]
    Benchmark(Box<BenchmarkError>),
    /// Trials cannot be submitted to a cluster.
    #[error(transparent)]
    Submit(#[from] SubmitError),
}

impl BenchError {
    /// 2 for usage, 3 for data that cannot be used.
    pub fn exit_code(&self) -> u8 {
        match self {
            Self::Cli(error) => error.exit_code(),
            Self::Benchmark(error) => match **error {
                BenchmarkError::OtherCampaign { .. }
                | BenchmarkError::NoThreads { .. }
                | BenchmarkError::NoStore { .. }
                | BenchmarkError::NoTruthSheets { .. }
                | BenchmarkError::NoPopulation { .. }
                | BenchmarkError::UnusableBenchFile { .. }
                | BenchmarkError::TrialFolder { .. }
                | BenchmarkError::Population(_) => 2,
                _ => 3,
            },
            Self::Submit(_) => 2,
        }
    }

    /// Prints the error, and advice where there is any, on the standard error.
    pub fn print(&self) {
        match self {
            Self::Cli(error) => error.print(),
            Self::Benchmark(error) => print_error(error, None),
            Self::Submit(error) => print_error(error, error.help()),
        }
    }
}

impl From<BenchmarkError> for BenchError {
    fn from(error: BenchmarkError) -> Self {
        match error {
            BenchmarkError::Experiment(error) => Self::Cli(Box::new((*error).into())),
            error => Self::Benchmark(Box::new(error)),
        }
    }
}

impl From<CliError> for BenchError {
    fn from(error: CliError) -> Self {
        Self::Cli(Box::new(error))
    }
}

impl From<DocumentError> for BenchError {
    fn from(error: DocumentError) -> Self {
        Self::Cli(Box::new(error.into()))
    }
}

impl From<ExperimentError> for BenchError {
    fn from(error: ExperimentError) -> Self {
        Self::Cli(Box::new(error.into()))
    }
}

impl From<LearnerError> for BenchError {
    fn from(error: LearnerError) -> Self {
        Self::Cli(Box::new(error.into()))
    }
}

impl From<LogError> for BenchError {
    fn from(error: LogError) -> Self {
        Self::Cli(Box::new(error.into()))
    }
}

impl From<ReportError> for BenchError {
    fn from(error: ReportError) -> Self {
        Self::Cli(Box::new(error.into()))
    }
}

impl From<RobotError> for BenchError {
    fn from(error: RobotError) -> Self {
        Self::Cli(Box::new(error.into()))
    }
}

impl From<io::Error> for BenchError {
    fn from(error: io::Error) -> Self {
        Self::Cli(Box::new(error.into()))
    }
}
