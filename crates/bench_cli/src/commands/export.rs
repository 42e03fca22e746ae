use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread::available_parallelism;

use benchmark::{BenchSet, ExportRequest, export_set};
use clap::builder::{PossibleValuesParser, TypedValueParser};
use cli::{Line, display_path, print};

use crate::error::BenchError;
use crate::exit_status::BenchExitStatus;

/// Arguments of `export`.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// The set: 12 short trials, 120, 60 with wrong descriptions, servos and spoilt logs, or logs of real arms
    #[arg(long, value_parser = sets())]
    set: BenchSet,
    /// Of the set recorded: the folder that holds a folder of logs an arm
    #[arg(long, value_name = "DIR", required_if_eq("set", "recorded"))]
    data: Option<PathBuf>,
    /// Folder for the trials, empty or absent
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// File for the truth, outside that folder; DIR with the ending .truth.json where it is left out
    #[arg(long, value_name = "FILE")]
    truth: Option<PathBuf>,
    /// Seed of a set that nobody else can make; the public set where it is left out
    #[arg(long, value_name = "N")]
    seed: Option<u64>,
    /// Make only the first trials
    #[arg(long, value_name = "N")]
    first: Option<usize>,
    /// Trials made at a time; as many as there are processors where it is left out
    #[arg(long, value_name = "N")]
    jobs: Option<NonZeroUsize>,
    /// Print nothing but errors
    #[arg(long)]
    quiet: bool,
}

/// Sets by their names.
fn sets() -> impl TypedValueParser<Value = BenchSet> {
    let named = |name: String| BenchSet::ALL.into_iter().find(|set| set.name() == name);
    PossibleValuesParser::new(BenchSet::ALL.map(BenchSet::name))
        .try_map(move |name| named(name).ok_or("no such set"))
}

/// Writes the trials of a set without their truth.
pub fn run(arguments: &Arguments) -> Result<BenchExitStatus, BenchError> {
    let request = ExportRequest {
        set: arguments.set,
        data: arguments.data.clone().unwrap_or_default(),
        seed: arguments.seed,
        most: arguments.first,
        folder: arguments.out.clone(),
        truth: arguments.truth.clone().unwrap_or_else(|| beside(&arguments.out)),
        jobs: arguments.jobs.or(available_parallelism().ok()).map_or(1, NonZeroUsize::get),
    };
    let (line, made) = (Line::new(), AtomicUsize::new(0));
    let on_trial = || {
        let count = 1 + made.fetch_add(1, Ordering::Relaxed);
        if !arguments.quiet {
            line.say(&format!("{count} trials made"));
        }
    };
    let exported = export_set(&request, &on_trial);
    line.finish();
    let manifest = exported?;
    if !arguments.quiet {
        print(&format!(
            "{} trials of {} in {}\ntruth  {}, SHA-256 {}\n",
            manifest.trials.len(),
            manifest.set.name(),
            display_path(&arguments.out),
            display_path(&request.truth),
            manifest.truth_sha256
        ))?;
    }
    Ok(BenchExitStatus::Good)
}

/// The file of the truth beside a folder.
fn beside(folder: &Path) -> PathBuf {
    let name = folder.file_name().unwrap_or_default().to_string_lossy();
    folder.with_file_name(format!("{name}.truth.json"))
}
