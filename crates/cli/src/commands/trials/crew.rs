use std::num::NonZeroUsize;
use std::path::PathBuf;
use std::thread::available_parallelism;

use evaluation::{Crew, Part, TrialLogs};

/// Arguments of `trials work`.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// The folder of a campaign that was planned
    #[arg(value_name = "DIR")]
    pub folder: PathBuf,
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
    /// Print nothing but errors
    #[arg(long)]
    pub quiet: bool,
}

impl Arguments {
    /// Who makes which trials.
    pub fn crew(&self) -> Crew {
        let jobs = self.jobs.or(available_parallelism().ok()).map_or(1, NonZeroUsize::get);
        let logs = if self.keep { TrialLogs::Kept } else { TrialLogs::Removed };
        Crew { jobs, part: self.part, logs, store: self.store.clone() }
    }
}
