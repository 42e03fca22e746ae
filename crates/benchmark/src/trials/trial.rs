use std::path::{Path, PathBuf};
use std::time::Instant;

use document::Document;
use experiment::Blinded;
use logs::Run;
use robot::Robot;
use simulator::scenario::{Scenario, ScenarioSpec};
use simulator::{LogFormat, Simulation};

use crate::error::BenchmarkError;
use crate::panel::judgement::Judgement;
use crate::panel::population_trial::judge;
use crate::trial_folder::{HELD_OUT, LOGS, NOMINAL, TRUTH, read_runs, unusable};
use crate::trials::hidden::Hidden;
use crate::trials::scenario_sheet::scenario_sheet;

/// One blind trial: an arm with hidden effects, logged, diagnosed and judged.
///
/// ```text
/// scenario, hidden, seed --simulate--> nominal/, logs/ --diagnose, least squares--> answers --\
///                                 \--> held_out/ ----- errors of all models -----> held out ------> Judgement
///                                  \--> truth/, sheet.json ---------------------- opened last -/
/// ```
///
/// Its folder is that of a trial of a population. The judgement depends on these fields alone, so that a trial can be
/// repeated anywhere and at any time.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Trial {
    /// The scenario to start from: the arm, its sensors and its runs.
    pub scenario: PathBuf,
    /// The hidden effects.
    pub hidden: Hidden,
    /// Seed of all random draws: places and sizes of the hidden effects, noise of the sensors.
    pub seed: u64,
    /// Further settings of the scenario, `key=value` as `--set` takes them.
    pub settings: Vec<String>,
    /// Whether the last run is held out from the diagnosis, to show how well its effort is predicted.
    pub gains: bool,
}

impl Trial {
    /// Path of its folder under `root`, such as `root/backlash/7`.
    pub fn folder(&self, root: &Path) -> PathBuf {
        root.join(self.hidden.to_string()).join(self.seed.to_string())
    }

    /// Makes the trial in `folder`, diagnoses its logs through the files and judges the answer.
    ///
    /// # Errors
    ///
    /// [`BenchmarkError`] when the scenario cannot be used or simulated, or a file cannot be written or read.
    pub fn run(&self, folder: &Path) -> Result<Judgement, BenchmarkError> {
        let start = Instant::now();
        let simulated = self.make(folder)?;
        let logs_s = if simulated { start.elapsed().as_secs_f64() } else { 0.0 };
        judge(folder, &self.hidden.without(), logs_s)
    }

    /// Makes the folder of the trial: `nominal/`, `logs/`, `truth/`, `sheet.json`, and `held_out/` where a run is held
    /// out. Returns whether the logs were simulated: existing ones of the same scenario are used again, even where its
    /// robot has moved to another path.
    ///
    /// # Errors
    ///
    /// Those of [`run`](Self::run).
    pub fn make(&self, folder: &Path) -> Result<bool, BenchmarkError> {
        let scenario = self.scenario()?;
        let loaded = Robot::load(scenario.robot_file())?;
        let simulates = !self.holds(folder, &scenario);
        if simulates {
            let simulation = simulator::simulate(&scenario, &|| {})?;
            self.write(folder, &scenario, simulation)?;
        }
        let urdf = loaded.urdf_path.canonicalize().unwrap_or_else(|_| loaded.urdf_path.clone());
        let nominal = loaded.to_toml(&loaded.robot, &urdf.display().to_string())?;
        write_text(&subfolder(folder, NOMINAL)?.join("robot.toml"), &nominal)?;
        let truth = Blinded::open(&folder.join(TRUTH))?;
        let given = read_runs(&folder.join(LOGS), &loaded.robot)?;
        let without = self.hidden.without();
        scenario_sheet(&truth, &without, &scenario, (&loaded, &given)).write(folder)?;
        Ok(simulates)
    }

    /// Whether a folder holds all logs of the trial, so that they can be used again.
    pub(super) fn is_logged(&self, folder: &Path) -> bool {
        self.scenario().is_ok_and(|scenario| self.holds(folder, &scenario))
    }

    fn scenario(&self) -> Result<Scenario, BenchmarkError> {
        let mut document = Document::read(&self.scenario)?;
        document.set(&format!("seed={}", self.seed))?;
        for setting in self.settings.iter().chain(&self.hidden.settings()) {
            document.set(setting)?;
        }
        Ok(Scenario::from_document(&document)?)
    }

    /// Writes the logs and the truth, which is complete when `truth.json` is there.
    fn write(
        &self,
        folder: &Path,
        scenario: &Scenario,
        simulation: Simulation,
    ) -> Result<(), BenchmarkError> {
        for name in [TRUTH, LOGS, HELD_OUT] {
            let old = folder.join(name);
            if old.exists() {
                std::fs::remove_dir_all(&old).map_err(unusable(&old))?;
            }
        }
        let Simulation { mut runs, .. } = simulation;
        let held_out: Vec<Run> = if self.gains { runs.pop().into_iter().collect() } else { vec![] };
        for (name, runs) in [(LOGS, &runs), (HELD_OUT, &held_out)] {
            for run in runs {
                let file = format!("{}.{}", run.name, LogFormat::Parquet.extension());
                logs::write_parquet(&subfolder(folder, name)?.join(file), run)?;
            }
        }
        let truth = Simulation { runs: Vec::new(), ..simulation };
        Ok(simulator::write(&subfolder(folder, TRUTH)?, scenario, &truth, LogFormat::Parquet)?)
    }

    /// Whether a folder holds all logs of this scenario: `truth.json` is written last.
    fn holds(&self, folder: &Path, scenario: &Scenario) -> bool {
        let spec = |document: Document| document.parse::<ScenarioSpec>().ok();
        let without_robot =
            |document| spec(document).map(|spec| ScenarioSpec { robot: PathBuf::new(), ..spec });
        let truth = folder.join(TRUTH);
        let there = Document::read(truth.join("scenario.toml")).ok().and_then(without_robot);
        let wanted = Document::from_text("scenario.toml", scenario.self_contained_text())
            .ok()
            .and_then(without_robot);
        let is_whole = truth.join(Blinded::FILE).is_file();
        is_whole
            && folder.join(HELD_OUT).is_dir() == self.gains
            && wanted.is_some()
            && there == wanted
    }
}

/// A folder inside that of a trial, made where it is missing.
fn subfolder(folder: &Path, name: &str) -> Result<PathBuf, BenchmarkError> {
    let inside = folder.join(name);
    std::fs::create_dir_all(&inside).map_err(unusable(folder))?;
    Ok(inside)
}

fn write_text(path: &Path, text: &str) -> Result<(), BenchmarkError> {
    Ok(logs::replace_file(path, |file| Ok(std::io::Write::write_all(file, text.as_bytes())?))?)
}
