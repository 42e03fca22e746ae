use std::path::PathBuf;

use benchmark::BenchmarkError;
use cli::print;
use population::{PopulationError, Store};

use crate::error::BenchError;
use crate::exit_status::BenchExitStatus;

/// Arguments of `sheets`.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// A store of `work --store`, of any format
    #[arg(value_name = "STORE")]
    store: PathBuf,
}

/// Works out what was visible in the trials of a store anew.
pub fn run(arguments: &Arguments) -> Result<BenchExitStatus, BenchError> {
    let of = |error: PopulationError| BenchError::from(BenchmarkError::from(error));
    let mut count = 0;
    Store::open(&arguments.store).map_err(of)?.sheets_again(&mut |_| count += 1).map_err(of)?;
    print(&format!("{count} sheets were worked out anew\n"))?;
    Ok(BenchExitStatus::Good)
}
