pub(super) mod comparison;
pub(crate) mod tracking_result;

use std::path::{Path, PathBuf};

use experiment::FeedforwardKind;
use report::TrackingComparison;

use crate::error::CliError;
use crate::exit_status::ExitStatus;
use crate::output::{display_path, print_answer};
use crate::progress::Line;
use crate::watch::Watch;

use self::tracking_result::{TrackingRequest, TrackingResult};
use crate::quiet::Quiet;

/// Arguments of `track`.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// The tracking scenario (TOML)
    scenario: PathBuf,
    /// Folder for the report, figures, logs, recordings and models
    #[arg(long, value_name = "DIR", default_value = "out/track")]
    out: PathBuf,
    /// Models that were learned before: the folder models of `track` or `learn`, instead of
    /// simulating logs and learning from them
    #[arg(long, value_name = "DIR")]
    learned: Option<PathBuf>,
    /// What is fed forward, with commas between, instead of the scenario's: none, gravity, or a
    /// model of `learn`
    #[arg(long, value_name = "NAME", value_delimiter = ',')]
    feedforward: Vec<FeedforwardKind>,
    /// A value instead of the scenario's, such as control.gains=stiff; may be given more than
    /// once
    #[arg(long, value_name = "KEY=VALUE")]
    set: Vec<String>,
    /// Show the runs in a viewer that is running (rerun) while they go on
    #[cfg_attr(feature = "recording", arg(long))]
    #[cfg_attr(not(feature = "recording"), arg(skip))]
    live: bool,
    /// Print the JSON instead of the table
    #[arg(long)]
    json: bool,
    /// Print nothing but errors, and the JSON if it is asked for
    #[arg(long)]
    quiet: bool,
}

/// Tracks the motion of a scenario with every feedforward and compares them.
pub fn run(arguments: &Arguments) -> Result<ExitStatus, CliError> {
    let request = TrackingRequest {
        scenario: &arguments.scenario,
        set: &arguments.set,
        feedforward: &arguments.feedforward,
        learned: arguments.learned.as_deref(),
        out: Some(&arguments.out),
        live: arguments.live,
        command: None,
    };
    let watch = Watch::new((!arguments.quiet).then(Line::new))?;
    let result = TrackingResult::new(&request, &watch);
    watch.finish();
    let result = result?;
    // A full disk does not keep a long run from being told.
    let written = result.write(&arguments.out);
    say(arguments, result.comparison())?;
    written?;
    match result.problems().into_iter().next() {
        None => Ok(ExitStatus::Good),
        Some(problem) => Err(CliError::Incomplete { problem }),
    }
}

/// Table or JSON on the standard output; with JSON, where the files lie on the standard error.
fn say(arguments: &Arguments, comparison: &TrackingComparison) -> Result<(), CliError> {
    let of = |name: &str| display_path(&arguments.out.join(Path::new(name)));
    let recordings = if recording::IS_BUILT {
        let folder = display_path(&arguments.out);
        format!("recordings     {}\nboth           plumbline view {folder}\n", of("recordings"))
    } else {
        String::new()
    };
    let closing = format!("report         {}\n{recordings}", of("report.html"));
    let json = arguments.json.then(|| comparison.json()).transpose()?;
    print_answer(Quiet(arguments.quiet), json.as_deref(), || comparison.text(), &closing)
}
