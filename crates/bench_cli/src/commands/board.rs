use std::path::PathBuf;

use benchmark::{BenchBoard, BenchScores, BenchmarkError};
use cli::print;

use crate::error::BenchError;
use crate::exit_status::BenchExitStatus;

/// Arguments of `board`.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// Scores of the entrants, as `score --json` prints them
    #[arg(value_name = "FILE", required = true)]
    scores: Vec<PathBuf>,
}

/// Prints the page on CauseBench with the scores of these entrants.
pub fn run(arguments: &Arguments) -> Result<BenchExitStatus, BenchError> {
    let read: Result<Vec<BenchScores>, BenchmarkError> =
        arguments.scores.iter().map(|path| BenchScores::open(path)).collect();
    print(&BenchBoard::new(read?).page())?;
    Ok(BenchExitStatus::Good)
}
