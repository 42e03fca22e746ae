mod comparison;
mod tracked;

use std::path::{Path, PathBuf};

use experiment::{FeedforwardKind, TrackedRun, TrackingScenario};
use report::{ReportError, TrackingComparison};

use crate::Outcome;
use crate::error::CliError;
use crate::output::{print, shown, tell};
use crate::progress::Line;
use crate::watch::Watch;

pub(super) use self::comparison::comparison;
pub use self::tracked::{Asked, Tracked};

/// Arguments of `track`.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// The tracking scenario (TOML)
    scenario: PathBuf,
    /// Folder for the report, figures, logs, recordings and models
    #[arg(long, value_name = "DIR")]
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
pub fn run(arguments: &Arguments) -> Result<Outcome, CliError> {
    let asked = Asked {
        scenario: &arguments.scenario,
        set: &arguments.set,
        feedforward: &arguments.feedforward,
        learned: arguments.learned.as_deref(),
        out: Some(&arguments.out),
        live: arguments.live,
        command: None,
    };
    let watch = Watch::new((!arguments.quiet).then(Line::new))?;
    let tracked = Tracked::new(&asked, &watch);
    watch.finish();
    let tracked = tracked?;
    // A full disk does not keep a long run from being told.
    let written = tracked.write(&arguments.out);
    say(arguments, tracked.comparison())?;
    written?;
    match tracked.problems().into_iter().next() {
        None => Ok(Outcome::Good),
        Some(problem) => Err(CliError::Incomplete { problem }),
    }
}

/// What of the runs could not be written.
pub(super) fn problems(runs: &[TrackedRun]) -> impl Iterator<Item = &String> {
    runs.iter().filter_map(|run| run.written.as_ref()).flat_map(|written| &written.problems)
}

/// Writes an output folder, all but the logs, recordings and models.
pub(super) fn write(
    out: &Path,
    scenario: &TrackingScenario,
    comparison: &TrackingComparison,
) -> Result<(), ReportError> {
    let mut files = vec![
        ("scenario.toml", scenario.resolved().to_owned()),
        ("tracking.json", comparison.json()?),
        ("report.html", comparison.page()?),
        ("errors.svg", comparison.error_figure()?),
        ("motion.svg", comparison.motion_figure(&elbow_and_wrist(scenario))?),
    ];
    if let Some(figure) = comparison.sweep_figure()? {
        files.push(("gains.svg", figure));
    }
    let files: Vec<(&str, &[u8])> =
        files.iter().map(|(name, text)| (*name, text.as_bytes())).collect();
    report::write_folder(out, &files)
}

/// The joints of figure 4 of Nguyen-Tuong & Peters 2010, 4 to 6, as far as there are so many.
fn elbow_and_wrist(scenario: &TrackingScenario) -> Vec<usize> {
    let joints = scenario.robot().joint_count();
    if joints >= 6 { vec![3, 4, 5] } else { (0..joints.min(3)).collect() }
}

/// Table or JSON on the standard output; with JSON, where the files lie on the standard error.
fn say(arguments: &Arguments, comparison: &TrackingComparison) -> Result<(), CliError> {
    let of = |name: &str| shown(&arguments.out.join(Path::new(name)));
    let recordings = if recording::IS_BUILT {
        let folder = shown(&arguments.out);
        format!("recordings     {}\nboth           plumbline view {folder}\n", of("recordings"))
    } else {
        String::new()
    };
    let closing = format!("report         {}\n{recordings}", of("report.html"));
    if arguments.json {
        print(&comparison.json()?)?;
    }
    match (arguments.quiet, arguments.json) {
        (true, _) => {}
        (false, true) => tell(&closing.trim_end()),
        (false, false) => print(&format!("{}\n{closing}", comparison.text()))?,
    }
    Ok(())
}
