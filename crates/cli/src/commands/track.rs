mod comparison;

use std::path::{Path, PathBuf};

use document::Document;
use evaluation::{
    FeedforwardKind, Learned, Outputs, TrackedRun, TrackingScenario, simulated_logs, sweep,
    track_all,
};
use recording::Live;
use report::{ReportError, TrackingComparison};

use crate::Outcome;
use crate::error::CliError;
use crate::output::{create_folder, print, shown, tell};
use crate::progress::Line;
use crate::watch::Watch;

pub(super) use self::comparison::comparison;

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
    #[arg(long)]
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
    let scenario = TrackingScenario::from_document(&document(arguments)?)?;
    let outputs = Outputs {
        logs: arguments.out.join("logs"),
        recordings: arguments.out.join("recordings"),
        live: if arguments.live { Live::On } else { Live::Off },
    };
    for folder in [&arguments.out, &outputs.logs, &outputs.recordings] {
        create_folder(folder)?;
    }
    let watch = Watch::new((!arguments.quiet).then(Line::new))?;
    let learned = learned(arguments, &scenario, &watch);
    let tracked = learned.and_then(|learned| {
        let runs = track_all(&scenario, &learned, Some(&outputs), &watch)?;
        let swept = sweep(&scenario, &learned, &watch)?;
        Ok((runs, swept))
    });
    watch.finish();
    let (runs, swept) = tracked?;
    let comparison = comparison(&arguments.scenario, &scenario, &runs, swept.as_ref())?;
    // A full disk does not keep a long run from being told.
    let written = write(&arguments.out, &scenario, &comparison);
    say(arguments, &comparison)?;
    written?;
    match problems(&runs).next() {
        None => Ok(Outcome::Good),
        Some(problem) => Err(CliError::Incomplete { problem: problem.clone() }),
    }
}

/// What of the runs could not be written.
pub(super) fn problems(runs: &[TrackedRun]) -> impl Iterator<Item = &String> {
    runs.iter().filter_map(|run| run.written.as_ref()).flat_map(|written| &written.problems)
}

fn document(arguments: &Arguments) -> Result<Document, CliError> {
    let mut document = Document::read(&arguments.scenario)?;
    for assignment in &arguments.set {
        document.set(assignment)?;
    }
    if !arguments.feedforward.is_empty() {
        let names: Vec<String> =
            arguments.feedforward.iter().map(|kind| format!("{:?}", kind.name())).collect();
        document.set(&format!("feedforward=[{}]", names.join(",")))?;
    }
    Ok(document)
}

/// The models, from a folder or from logs that are simulated for them.
fn learned(
    arguments: &Arguments,
    scenario: &TrackingScenario,
    watch: &Watch,
) -> Result<Learned, CliError> {
    if let Some(folder) = &arguments.learned {
        return Ok(Learned::load(scenario, folder)?);
    }
    let logs = simulated_logs(scenario, watch)?;
    let learned = Learned::learn(scenario, &logs, None, watch)?;
    let folder = arguments.out.join("models");
    create_folder(&folder)?;
    learned.save(&folder)?;
    Ok(learned)
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
    let closing = format!(
        "report         {}\nrecordings     {}\nboth           plumbline view {}\n",
        of("report.html"),
        of("recordings"),
        shown(&arguments.out)
    );
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
