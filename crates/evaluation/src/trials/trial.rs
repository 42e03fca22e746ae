use std::path::{Path, PathBuf};

use catalogue::EffectKind;
use diagnosis::{Settings, Silent};
use document::Document;
use logs::ReadOptions;
use robot::{Loaded, Robot};
use simulator::LogFormat;
use simulator::scenario::{Scenario, ScenarioSpec};

use super::{Hidden, Score};
use crate::{EvaluationError, Sealed};

/// One blind trial: an arm in which something is hidden, logged, diagnosed and scored.
///
/// ```text
/// scenario, hidden, seed --simulate--> *.parquet --diagnose--> diagnosis --\
///                                 \--> truth.json ---------- opened last ----> Score
/// ```
///
/// The score follows from these fields alone, so that a trial may be made anywhere, at any time
/// and again.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Trial {
    /// The scenario to start from: the arm, its sensors and its runs.
    pub scenario: PathBuf,
    /// What is hidden.
    pub hidden: Hidden,
    /// Seed of every draw: place and size of what is hidden, noise of the sensors.
    pub seed: u64,
    /// Settings of the scenario besides, `key=value` as `--set` takes them.
    pub settings: Vec<String>,
}

impl Trial {
    /// Where it lies among others: `root/backlash/7`.
    pub fn folder(&self, root: &Path) -> PathBuf {
        root.join(self.hidden.to_string()).join(self.seed.to_string())
    }

    /// Simulates the logs into `folder`, diagnoses them through the files and scores the answer.
    ///
    /// Logs that are there are used again where they are of the same scenario; its robot may then
    /// lie elsewhere.
    ///
    /// # Errors
    ///
    /// [`EvaluationError`] when the scenario cannot be meant or simulated, a file cannot be
    /// written or read, or the logs cannot be diagnosed.
    pub fn run(&self, folder: &Path) -> Result<Score, EvaluationError> {
        let scenario = self.scenario()?;
        if !holds(folder, &scenario) {
            std::fs::create_dir_all(folder).map_err(unusable(folder))?;
            let simulation = simulator::simulate(&scenario, &|| {})?;
            simulator::write(folder, &scenario, &simulation, LogFormat::Parquet)?;
        }
        judge(folder, &Robot::load(scenario.robot_file())?, &self.hidden.without())
    }

    /// Whether a folder holds its logs, whole, so that they would be used again.
    pub(super) fn is_logged(&self, folder: &Path) -> bool {
        self.scenario().is_ok_and(|scenario| holds(folder, &scenario))
    }

    fn scenario(&self) -> Result<Scenario, EvaluationError> {
        let mut document = Document::read(&self.scenario)?;
        document.set(&format!("seed={}", self.seed))?;
        for setting in self.settings.iter().chain(&self.hidden.settings()) {
            document.set(setting)?;
        }
        Ok(Scenario::from_document(&document)?)
    }
}

/// Diagnoses the logs of a folder as `plumbline diagnose` does, `robot` being the nominal one,
/// and only then opens `truth.json` and scores the answer; `without` are effects that it does not
/// look for.
///
/// # Errors
///
/// [`EvaluationError`] when a log or the truth cannot be read, or the logs cannot be diagnosed.
pub fn judge(
    folder: &Path,
    robot: &Loaded,
    without: &[EffectKind],
) -> Result<Score, EvaluationError> {
    let options = ReadOptions { map: None, effort: "effort" };
    let read = |path: &PathBuf| logs::read_run(path, &robot.robot, &options);
    let runs = logs_of(folder)?.iter().map(read).collect::<Result<Vec<_>, _>>()?;
    let settings = Settings {
        control_rate_hz: robot.control.rate_hz,
        without: without.to_vec(),
        ..Settings::default()
    };
    let outcome = diagnosis::diagnose(&robot.robot, &runs, &settings, &Silent)?;
    let sealed = Sealed::open(folder)?;
    let unknown = sealed.effects.iter().any(|truth| without.contains(&truth.effect));
    let score = Score::new(&outcome.diagnosis, &sealed.effects, sealed.seed);
    Ok(Score { looked_for: !unknown, ..score })
}

/// The logs of a folder, by name.
fn logs_of(folder: &Path) -> Result<Vec<PathBuf>, EvaluationError> {
    let entries = std::fs::read_dir(folder).map_err(unusable(folder))?.map(|e| e.map(|e| e.path()));
    let mut paths = entries.collect::<Result<Vec<_>, _>>().map_err(unusable(folder))?;
    paths.retain(|path| path.extension().is_some_and(|e| e == LogFormat::Parquet.extension()));
    paths.sort();
    if paths.is_empty() {
        return Err(EvaluationError::NoLogs { path: folder.to_owned() });
    }
    Ok(paths)
}

pub(super) fn unusable(folder: &Path) -> impl Fn(std::io::Error) -> EvaluationError {
    |error| EvaluationError::TrialFolder { path: folder.to_owned(), reason: error.to_string() }
}

/// Whether a folder holds the logs of this scenario, whole: the truth is the last to appear.
fn holds(folder: &Path, scenario: &Scenario) -> bool {
    let spec = |document: Document| document.parse::<ScenarioSpec>().ok();
    let said = |document| spec(document).map(|spec| ScenarioSpec { robot: PathBuf::new(), ..spec });
    let there = Document::read(folder.join("scenario.toml")).ok().and_then(said);
    let wanted = Document::from_text("scenario.toml", scenario.resolved()).ok().and_then(said);
    folder.join(Sealed::FILE).is_file() && wanted.is_some() && there == wanted
}
