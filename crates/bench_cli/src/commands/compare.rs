use std::path::PathBuf;

use benchmark::PairedComparison;
use cli::{print, print_json};

use crate::error::BenchError;
use crate::exit_status::BenchExitStatus;

/// Arguments of `compare`.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// The first result: the folder of a campaign, or a trials.parquet
    #[arg(value_name = "A")]
    first: PathBuf,
    /// The second, of the same campaign, which is better where it wins
    #[arg(value_name = "B")]
    second: PathBuf,
    /// Print JSON instead of tables
    #[arg(long)]
    json: bool,
}

/// Compares two results of the same trials.
pub fn run(arguments: &Arguments) -> Result<BenchExitStatus, BenchError> {
    let comparison = PairedComparison::read(&arguments.first, &arguments.second)?;
    if arguments.json {
        print_json(&comparison)?;
    } else {
        print(&comparison.text())?;
    }
    Ok(BenchExitStatus::Good)
}
