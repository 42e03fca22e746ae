pub mod run_folder;
mod stages;

use std::cell::OnceCell;
use std::path::{Path, PathBuf};

use document::Document;
use experiment::Experiment;
use report::{Provenance, RunReport};
use serde::Deserialize;
use serde::de::IgnoredAny;

use crate::error::CliError;
use crate::exit_status::ExitStatus;
use crate::input::{hash, provenance};
use crate::messages::tell;
use crate::output::{create_folder, display_path, print_answer};
use crate::progress::Line;
use crate::watch::Watch;

use self::stages::Stages;
use crate::quiet::Quiet;

/// Arguments of `run`.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// The scenario of an arm, or a tracking scenario (TOML)
    scenario: PathBuf,
    #[command(flatten)]
    pub output: Output,
    /// Seed of every random draw of the arm, instead of its scenario's
    #[arg(long, value_parser = clap::value_parser!(u64).range(0..=i64::MAX as u64))]
    seed: Option<u64>,
    /// A value instead of the scenario's, such as engine.step_ms=0.2; may be given more than once
    #[arg(long, value_name = "KEY=VALUE")]
    set: Vec<String>,
}

/// Where a run is written and what is printed of it.
#[derive(Debug, clap::Args)]
pub struct Output {
    /// Folder for all that the command makes [default: out/ and the name of the scenario; of demo out/demo, or
    /// out/demo_ROBOT]
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Print metrics.json instead of the text
    #[arg(long)]
    json: bool,
    /// Print nothing but errors, and the JSON if it is asked for
    #[arg(long)]
    pub quiet: bool,
}

impl Output {
    /// Words on the standard error, unless nothing is to be printed.
    pub fn leave(&self, words: &str) {
        if !self.quiet {
            tell(&words);
        }
    }

    /// Text or JSON on the standard output; with JSON, where the files lie on the standard error.
    ///
    /// # Errors
    ///
    /// [`CliError::Output`].
    pub fn say(&self, json: &str, text: &str, closing: &str) -> Result<(), CliError> {
        let json = self.json.then_some(json);
        print_answer(Quiet(self.quiet), json, || text.to_owned(), closing)
    }
}

/// What tells the scenario of a figure from others.
#[derive(Deserialize)]
struct Kind {
    figure: Option<IgnoredAny>,
}

/// Simulates what a scenario describes, diagnoses it from its logs and measures what that gains.
pub fn run(arguments: &Arguments) -> Result<ExitStatus, CliError> {
    let mut document = Document::read(&arguments.scenario)?;
    for assignment in &arguments.set {
        document.set(assignment)?;
    }
    let stem = arguments.scenario.file_stem().unwrap_or_default();
    let out = arguments.output.out.clone().unwrap_or_else(|| Path::new("out").join(stem));
    if document.parse::<Kind>()?.figure.is_some() {
        return Err(CliError::Figure { path: arguments.scenario.clone() });
    }
    let experiment = Experiment::from_document(&document, arguments.seed)?;
    perform(&experiment, &arguments.scenario, &out, &arguments.output)
}

/// Runs an experiment, whose scenario was read from a file, and tells what came of it.
pub fn perform(
    experiment: &Experiment,
    scenario: &Path,
    out: &Path,
    output: &Output,
) -> Result<ExitStatus, CliError> {
    create_folder(out)?;
    let watch = Watch::of_all((!output.quiet).then(Line::new));
    let made = Stages { experiment, out, scenario, watch: &watch, drawn: OnceCell::new() }.all();
    watch.finish();
    let (metrics, told) = made?;
    let next = next(out);
    let report = RunReport {
        metrics: &metrics,
        robot: experiment.plant().robot(),
        diagnosis: &told.diagnosis,
        motion: &told.motion,
        next: &next,
        provenance: &origin(experiment, scenario)?,
    };
    write(experiment, &report, out)?;
    say(&report, out, output)?;
    Ok(ExitStatus::Good)
}

/// This program and the files that the run was made from.
fn origin(experiment: &Experiment, scenario: &Path) -> Result<Provenance, CliError> {
    let tracked = experiment.scenario();
    let mut origin = provenance(experiment.plant().robot_file(), tracked.loaded_robot(), None)?;
    origin.files.push(hash("scenario", scenario)?);
    origin.seed = Some(experiment.plant().seed());
    Ok(origin)
}

/// Commands that a reader may want next, each with what it does.
fn next(out: &Path) -> [[String; 2]; 3] {
    let of = |name: &str| display_path(&out.join(name));
    [
        [
            "The motion that separates what is still open, where something is:".to_owned(),
            format!("plumbline design --diagnosis {} --out {}", of("diagnosis"), of("next")),
        ],
        [
            if recording::IS_BUILT {
                "The measured arm beside the simulated one, in rerun's viewer:".to_owned()
            } else {
                "The report, in the browser:".to_owned()
            },
            format!("plumbline view {}", display_path(out)),
        ],
        ["The same for a log of your own:".to_owned(), OWN_LOG.to_owned()],
    ]
}

const OWN_LOG: &str =
    "plumbline diagnose --robot robot.urdf --log run_1.csv run_2.csv --out diagnosis";

fn write(experiment: &Experiment, report: &RunReport, out: &Path) -> Result<(), CliError> {
    let (json, page) = (report.json()?, report.page()?);
    report::write_folder(
        out,
        &[
            ("scenario.toml", experiment.self_contained_text().as_bytes()),
            ("metrics.json", json.as_bytes()),
            ("report.html", page.as_bytes()),
        ],
    )?;
    Ok(())
}

fn say(report: &RunReport, out: &Path, output: &Output) -> Result<(), CliError> {
    let of = |name: &str| display_path(&out.join(name));
    let recording = if recording::IS_BUILT {
        format!("recording      {} (plumbline view {})\n", of("recording.rrd"), display_path(out))
    } else {
        String::new()
    };
    let closing = format!(
        "report         {}\n{recording}extended model {}\nyour own log   {OWN_LOG}\n",
        of("report.html"),
        of("diagnosis/extended.toml"),
    );
    output.say(&report.json()?, &report.text(), &closing)
}
