use std::path::{Path, PathBuf};

use diagnosis::DiagnosisProgress;
use document::Document;
use logs::Run;
use simulator::LogFormat;
use simulator::scenario::Scenario;

use crate::error::CliError;
use crate::exit_status::ExitStatus;
use crate::output::{create_folder, display_path, print, table};
use crate::progress::Bar;

/// Arguments of `simulate`.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// The scenario (TOML)
    scenario: PathBuf,
    /// Folder for the logs, scenario.toml and truth.json
    #[arg(long, value_name = "DIR")]
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
    /// Print nothing but errors
    #[arg(long)]
    quiet: bool,
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
    if !arguments.quiet {
        print(&summary(arguments, &scenario, &simulation.runs))?;
    }
    Ok(ExitStatus::Good)
}

/// What was written. Says nothing of the effects: whoever diagnoses the logs has not seen them.
fn summary(arguments: &Arguments, scenario: &Scenario, runs: &[Run]) -> String {
    let rows = runs.iter().map(|run| {
        let duration = run.time.last().unwrap_or(&0.0) - run.time.first().unwrap_or(&0.0);
        let file = display_path(&arguments.log(&run.name));
        vec![run.name.clone(), run.time.len().to_string(), format!("{duration:.1}"), file]
    });
    let runs = table(&["run", ">rows", ">seconds", "log"], rows);
    let truth = display_path(&arguments.out.join("truth.json"));
    let logs: Vec<String> =
        scenario.runs().iter().map(|run| display_path(&arguments.log(&run.name))).collect();
    format!(
        "{runs}\nWhat was put in stands in {truth}, for scoring only. To diagnose the logs:\n  plumbline diagnose --robot {} --log {} --out {}\n",
        display_path(&near(scenario.robot_file())),
        logs.join(" "),
        display_path(&arguments.out.join("diagnosis"))
    )
}

/// The file as seen from here, without detours.
fn near(file: &Path) -> PathBuf {
    let whole = file.canonicalize().unwrap_or_else(|_| file.to_owned());
    let here = std::env::current_dir().and_then(|here| here.canonicalize());
    let inside = here.ok().and_then(|here| whole.strip_prefix(here).ok().map(Path::to_owned));
    inside.unwrap_or(whole)
}
