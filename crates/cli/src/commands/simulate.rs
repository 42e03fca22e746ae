use std::path::{Path, PathBuf};

use diagnosis::DiagnosisProgress;
use document::Document;
use logs::Run;
use schemars::{JsonSchema, Schema};
use serde::Serialize;
use simulator::LogFormat;
use simulator::scenario::Scenario;

use crate::error::CliError;
use crate::exit_status::ExitStatus;
use crate::output::{create_folder, display_path, print, print_json, table};
use crate::path::near;
use crate::progress::Bar;

/// Name and version of the schema of what `--json` prints.
const SCHEMA: &str = "plumbline.simulation/1";

/// Arguments of `simulate`.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// The scenario (TOML)
    scenario: PathBuf,
    /// Folder for the logs, scenario.toml and truth.json
    #[arg(long, value_name = "DIR", default_value = "out/simulate")]
    out: PathBuf,
    /// Seed of every random draw, instead of the scenario's
    #[arg(long, value_parser = clap::value_parser!(u64).range(0..=i64::MAX as u64))]
    seed: Option<u64>,
    /// A value instead of the scenario's, such as effect.0.coulomb_friction.level_nm=0.6; may be
    /// given more than once
    #[arg(long, value_name = "KEY=VALUE")]
    set: Vec<String>,
    /// Write the logs as CSV instead of Parquet
    #[arg(long)]
    csv: bool,
    /// Print JSON instead of the text
    #[arg(long)]
    json: bool,
    /// Print nothing but errors, and the JSON if it is asked for
    #[arg(long)]
    quiet: bool,
}

/// The JSON schema of what `--json` prints.
pub fn schema() -> Schema {
    report::written_schema::<SimulationSummary>(SCHEMA, "Plumbline simulation")
}

/// What was written, as `--json` prints it.
#[derive(Serialize, JsonSchema)]
struct SimulationSummary {
    schema: &'static str,
    /// The file that describes the robot.
    robot: String,
    /// The file that says what was put in.
    truth: String,
    /// The runs, in the order of the scenario.
    runs: Vec<SimulatedRun>,
}

/// The log of a run.
#[derive(Serialize, JsonSchema)]
struct SimulatedRun {
    name: String,
    /// Samples of its log.
    rows: usize,
    /// From its first sample to its last.
    duration_s: f64,
    /// The file of its log.
    log: String,
}

impl Arguments {
    fn format(&self) -> LogFormat {
        if self.csv { LogFormat::Csv } else { LogFormat::Parquet }
    }

    /// Where the log of a run is written.
    fn log(&self, run: &str) -> PathBuf {
        self.out.join(format!("{run}.{}", self.format().extension()))
    }
}

/// Simulates every run of a scenario and writes the logs and, apart from them, the truth.
pub fn run(arguments: &Arguments) -> Result<ExitStatus, CliError> {
    let mut document = Document::read(&arguments.scenario)?;
    for assignment in &arguments.set {
        document.set(assignment)?;
    }
    if let Some(seed) = arguments.seed {
        document.set(&format!("seed={seed}"))?;
    }
    let scenario = Scenario::from_document(&document)?;
    create_folder(&arguments.out)?;
    let bar = Bar::new();
    let seconds: f64 = scenario.runs().iter().map(|run| run.motion.duration_s()).sum();
    if !arguments.quiet {
        bar.stage("simulating (seconds of motion)", seconds as usize);
    }
    let simulation = simulator::simulate(&scenario, &|| {
        if !arguments.quiet {
            bar.step();
        }
    });
    bar.finish();
    let simulation = simulation?;
    simulator::write(&arguments.out, &scenario, &simulation, arguments.format())?;
    let summary = summary(arguments, &scenario, &simulation.runs);
    if arguments.json {
        print_json(&summary)?;
    } else if !arguments.quiet {
        print(&text(&summary, &arguments.out.join("diagnosis")))?;
    }
    Ok(ExitStatus::Good)
}

/// What was written. Says nothing of the effects: whoever diagnoses the logs has not seen them.
fn summary(arguments: &Arguments, scenario: &Scenario, runs: &[Run]) -> SimulationSummary {
    let runs = runs.iter().map(|run| SimulatedRun {
        name: run.name.clone(),
        rows: run.time.len(),
        duration_s: run.time.last().unwrap_or(&0.0) - run.time.first().unwrap_or(&0.0),
        log: display_path(&arguments.log(&run.name)),
    });
    SimulationSummary {
        schema: SCHEMA,
        robot: display_path(&near(scenario.robot_file())),
        truth: display_path(&arguments.out.join("truth.json")),
        runs: runs.collect(),
    }
}

/// The same as a table, and the command that diagnoses the logs into a folder.
fn text(written: &SimulationSummary, diagnosis: &Path) -> String {
    let rows = written.runs.iter().map(|run| {
        let duration = format!("{:.1}", run.duration_s);
        vec![run.name.clone(), run.rows.to_string(), duration, run.log.clone()]
    });
    let runs = table(&["run", ">rows", ">seconds", "log"], rows);
    let logs: Vec<&str> = written.runs.iter().map(|run| run.log.as_str()).collect();
    format!(
        "{runs}\nWhat was put in stands in {}, for scoring only. To diagnose the logs:\n  plumbline diagnose --robot {} --log {} --out {}\n",
        written.truth,
        written.robot,
        logs.join(" "),
        display_path(diagnosis)
    )
}
