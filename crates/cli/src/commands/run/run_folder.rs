use std::path::{Path, PathBuf};
use std::time::Instant;

use diagnosis::Settings;
use experiment::{Blinded, ExperimentError, Product, Stage, StageInputs, Staged};
use logs::{ReadOptions, Run};
use report::{DiagnosisSummary, Report};
use robot::{Loaded, Robot};
use serde::{Deserialize, Serialize};
use simulator::LogFormat;
use simulator::scenario::Scenario;

use crate::commands::diagnose;
use crate::error::CliError;
use crate::input::{hashes_of, provenance};
use crate::output::create_folder;
use crate::watch::Watch;

/// The folder of a run, in which its stages are made.
#[derive(Clone, Copy)]
pub struct RunFolder<'a> {
    /// The folder.
    pub out: &'a Path,
    /// Shows what is being done.
    pub watch: &'a Watch,
}

/// What a diagnosis came to, and how it is told.
pub struct DiagnosedRuns {
    /// What was found.
    pub outcome: diagnosis::DiagnosisRun,
    /// The verdict, for a recording.
    pub verdict: String,
    /// The whole of it, for a page.
    pub told: DiagnosisSummary,
}

impl RunFolder<'_> {
    /// What a stage of this name has made or makes, and a line that says so.
    ///
    /// # Errors
    ///
    /// [`ExperimentError::Stage`] when a file cannot be read or written, and what `make` refuses.
    pub fn stage<T: Serialize + for<'de> Deserialize<'de>, E: From<ExperimentError>>(
        &self,
        name: &str,
        words: &str,
        inputs: StageInputs,
        make: impl FnOnce() -> Result<Product<T>, E>,
    ) -> Result<Staged<T>, E> {
        let start = Instant::now();
        let made = Stage::new(self.out, name).make(inputs, make)?;
        let time = match made.is_kept {
            true => "made before".to_owned(),
            false => format!("{:.1} s", start.elapsed().as_secs_f64()),
        };
        self.watch.leave(&format!("{name:<19} {words:<50} {time:>12}"));
        Ok(made)
    }

    /// What every stage depends on: the program, the robot and something said.
    ///
    /// # Errors
    ///
    /// [`CliError`] when a file cannot be read or written.
    pub fn inputs(robot_file: &Path, loaded: &Loaded, said: &str) -> Result<StageInputs, CliError> {
        let inputs = StageInputs::of(env!("CARGO_PKG_VERSION")).and(said.as_bytes());
        Ok(inputs.and_file(robot_file)?.and_file(&loaded.urdf_path)?)
    }

    /// Simulates the logs of an arm into `logs`, a folder of the run, and the truth apart from
    /// them; `drawn` is the arm with the effects that its scenario may have hidden.
    ///
    /// # Errors
    ///
    /// [`CliError`] when a file cannot be read or written.
    pub fn logs<'s>(
        &self,
        name: &str,
        logs: &Path,
        plant: &Scenario,
        loaded: &Loaded,
        drawn: impl FnOnce() -> Result<&'s Scenario, CliError>,
    ) -> Result<Staged<()>, CliError> {
        let mut inputs = Self::inputs(plant.robot_file(), loaded, plant.self_contained_text())?;
        for run in plant.runs() {
            // A recorded motion may change where its name does not.
            for k in 0..=(100.0 * run.motion.duration_s()) as usize {
                let q = run.motion.at(0.01 * k as f64).q;
                inputs = q.iter().fold(inputs, |inputs, q| inputs.and(&q.to_le_bytes()));
            }
        }
        let seconds: f64 = plant.runs().iter().map(|run| run.motion.duration_s()).sum();
        let words = format!("{} runs, {seconds:.0} s of motion", plant.runs().len());
        self.stage(name, &words, inputs, || {
            create_folder(&self.out.join(logs))?;
            let drawn = drawn()?;
            experiment::Progress::begin(
                self.watch,
                &format!("simulating {seconds:.0} s of motion"),
            );
            let second = || experiment::Progress::second(self.watch);
            let simulation = simulator::simulate(drawn, &second)?;
            simulator::write(&self.out.join(logs), plant, &simulation, LogFormat::Parquet)?;
            let runs = plant.runs().iter().map(|run| log_file(logs, &run.name));
            let others = ["scenario.toml", Blinded::FILE].map(|name| logs.join(name));
            Ok(Product { value: (), files: runs.chain(others).collect() })
        })
    }

    /// Logs of the folder `logs` of the run, read from their files.
    ///
    /// # Errors
    ///
    /// [`CliError`] when a file cannot be read or written.
    pub fn runs(&self, logs: &Path, names: &[&str], robot: &Robot) -> Result<Vec<Run>, CliError> {
        let options = ReadOptions::default();
        let read =
            |name: &&str| logs::read_run(&self.out.join(log_file(logs, name)), robot, &options);
        Ok(names.iter().map(read).collect::<Result<_, _>>()?)
    }

    /// Diagnoses logs and writes what comes of it into `folder`, one of the run.
    ///
    /// # Errors
    ///
    /// [`CliError`] when a file cannot be read or written.
    pub fn diagnose(
        &self,
        folder: &Path,
        robot_file: &Path,
        loaded: &Loaded,
        runs: &[Run],
    ) -> Result<DiagnosedRuns, CliError> {
        let settings = Settings { control_rate_hz: loaded.control.rate_hz, ..Settings::default() };
        let outcome = diagnosis::diagnose(&loaded.robot, runs, &settings, self.watch)?;
        let mut provenance = provenance(robot_file, loaded, None)?;
        provenance.files.extend(hashes_of(runs));
        let descriptions = diagnose::descriptions(loaded, &outcome)?;
        let report = Report {
            descriptions: &descriptions,
            ..Report::new(&outcome, &loaded.robot, &provenance)
        };
        diagnose::write(&self.out.join(folder), loaded, &outcome, &report, None)?;
        let (verdict, told) = (report::markdown(&report), report::summarise(&report)?);
        Ok(DiagnosedRuns { outcome, verdict, told })
    }
}

/// What a diagnosis writes into a folder of the run.
pub fn diagnosis_files(folder: &Path) -> Vec<PathBuf> {
    let files = ["report.html", "figure.svg", "diagnosis.json", EXTENDED, "robot.urdf"];
    files.map(|name| folder.join(name)).to_vec()
}

/// The extended robot in the folder of a diagnosis.
pub const EXTENDED: &str = "extended.toml";

/// The log of a run in the folder `logs`.
pub fn log_file(logs: &Path, run: &str) -> PathBuf {
    logs.join(format!("{run}.{}", LogFormat::Parquet.extension()))
}
