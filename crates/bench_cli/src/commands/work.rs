use std::num::NonZeroUsize;
use std::path::PathBuf;
use std::thread::available_parallelism;

use benchmark::{CampaignFolder, ChosenTrials, Part, TrialLogs, Workers, work};
use cli::{Line, print};

use crate::commands::work_line::WorkLine;
use crate::error::BenchError;
use crate::exit_status::BenchExitStatus;

/// Arguments of `work`.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// The folder of a campaign that was planned
    #[arg(value_name = "DIR")]
    folder: PathBuf,
    /// Trials made at a time; as many as there are processors where it is left out
    #[arg(long, value_name = "N")]
    jobs: Option<NonZeroUsize>,
    /// One part of several, such as 1/4: every fourth trial
    #[arg(long, value_name = "K/N", default_value_t = Part::WHOLE)]
    part: Part,
    /// Keep the logs of every trial under logs/KIND/SEED
    #[arg(long)]
    keep: bool,
    /// Keep the logs of a population in this folder and take those that are there, so that a changed
    /// diagnosis is judged without a simulation
    #[arg(long, value_name = "DIR")]
    store: Option<PathBuf>,
    /// Make only the trials whose logs the store has, and simulate none
    #[arg(long, requires = "store")]
    stored: bool,
    /// Print nothing but errors
    #[arg(long)]
    quiet: bool,
}

impl Arguments {
    /// Who makes which trials.
    fn workers(&self) -> Workers {
        let jobs = self.jobs.or(available_parallelism().ok()).map_or(1, NonZeroUsize::get);
        let logs = if self.keep { TrialLogs::Kept } else { TrialLogs::Removed };
        let chosen = if self.stored { ChosenTrials::Stored } else { ChosenTrials::All };
        Workers { jobs, part: self.part, logs, store: self.store.clone(), chosen }
    }
}

/// Makes every trial that is left.
pub fn run(arguments: &Arguments) -> Result<BenchExitStatus, BenchError> {
    let folder = CampaignFolder::open(&arguments.folder)?;
    let workers = arguments.workers();
    let line = WorkLine::new(workers.jobs, (!arguments.quiet).then(Line::new))?;
    let worked = work(&folder, &workers, &line);
    line.finish();
    worked?;
    let left = folder.remaining(workers.part)?.len();
    if !arguments.quiet {
        print(&format!("{}\n", line.summary(left)))?;
    }
    Ok(if left == 0 { BenchExitStatus::Good } else { BenchExitStatus::Gap })
}
