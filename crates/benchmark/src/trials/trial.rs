use std::path::{Path, PathBuf};

use catalogue::EffectKind;
use diagnosis::{DiagnosisRun, Settings, Silent};
use document::Document;
use experiment::{Blinded, Experiment, Score};
use logs::Run;
use robot::{Loaded, Robot};
use simulator::LogFormat;
use simulator::scenario::{Scenario, ScenarioSpec};

use crate::error::BenchmarkError;
use crate::trial_folder::{read_runs, unusable};
use crate::trials::hidden::Hidden;

/// One blind trial: an arm with hidden effects, logged, diagnosed and scored.
///
/// ```text
/// scenario, hidden, seed --simulate--> *.parquet --diagnose--> diagnosis --\
///                                 \--> truth.json ---------- opened last ----> Score
/// with gains: diagnosis --> extended robot --torque, replay, tracking of the last run--> Gains
/// ```
///
/// The score depends on these fields alone, so that a trial can be repeated anywhere and at any time.
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
    /// Whether the last run is held out from the diagnosis and shows its gain.
    pub gains: bool,
}

impl Trial {
    /// Path of its folder under `root`, such as `root/backlash/7`.
    pub fn folder(&self, root: &Path) -> PathBuf {
        root.join(self.hidden.to_string()).join(self.seed.to_string())
    }

    /// Simulates the logs into `folder`, diagnoses them through the files and scores the answer.
    ///
    /// Existing logs of the same scenario are used again, even where its robot has moved to another path.
    ///
    /// # Errors
    ///
    /// [`BenchmarkError`] when the scenario cannot be used or simulated, a file cannot be written or read, or the
    /// logs cannot be diagnosed.
    pub fn run(&self, folder: &Path) -> Result<Score, BenchmarkError> {
        let document = self.document()?;
        let scenario = Scenario::from_document(&document)?;
        if !holds(folder, &scenario) {
            std::fs::create_dir_all(folder).map_err(unusable(folder))?;
            let simulation = simulator::simulate(&scenario, &|| {})?;
            simulator::write(folder, &scenario, &simulation, LogFormat::Parquet)?;
        }
        let (robot, without) = (Robot::load(scenario.robot_file())?, self.hidden.without());
        if !self.gains {
            return judge(folder, &robot, &without);
        }
        let experiment = Experiment::from_document(&document, None)?;
        let runs = read_runs(folder, &robot.robot)?;
        let is_learned = |run: &Run| experiment.learning_runs().any(|name| name == run.name);
        let (learned, test): (Vec<Run>, Vec<Run>) = runs.into_iter().partition(is_learned);
        let answer = answer(&robot, &learned, &without)?;
        let score = score_answer(folder, &answer, &without)?;
        let place = match &score.injected[..] {
            [one] => {
                robot.robot.joint_names().position(|name| one.at.joint.as_deref() == Some(name))
            }
            _ => None,
        };
        let drawn = experiment.draw_scenario()?;
        let gains = experiment.gains(&drawn, [&learned, &test], &answer.extended, place)?;
        Ok(Score { gains: Some(gains), ..score })
    }

    /// Whether a folder holds all logs of the trial, so that they can be used again.
    pub(super) fn is_logged(&self, folder: &Path) -> bool {
        self.scenario().is_ok_and(|scenario| holds(folder, &scenario))
    }

    fn scenario(&self) -> Result<Scenario, BenchmarkError> {
        Ok(Scenario::from_document(&self.document()?)?)
    }

    fn document(&self) -> Result<Document, BenchmarkError> {
        let mut document = Document::read(&self.scenario)?;
        document.set(&format!("seed={}", self.seed))?;
        for setting in self.settings.iter().chain(&self.hidden.settings()) {
            document.set(setting)?;
        }
        Ok(document)
    }
}

/// Diagnoses the logs of a folder as `plumbline diagnose` does, then opens `truth.json` and scores the answer.
/// `robot` is the nominal robot, `without` lists effects that the diagnosis does not look for.
///
/// # Errors
///
/// [`BenchmarkError`] when a log or the truth cannot be read, or the logs cannot be diagnosed.
pub fn judge(
    folder: &Path,
    robot: &Loaded,
    without: &[EffectKind],
) -> Result<Score, BenchmarkError> {
    let answer = answer(robot, &read_runs(folder, &robot.robot)?, without)?;
    score_answer(folder, &answer, without)
}

/// The outcome of a diagnosis that sees only the logs.
fn answer(
    robot: &Loaded,
    runs: &[Run],
    without: &[EffectKind],
) -> Result<DiagnosisRun, BenchmarkError> {
    let settings = Settings {
        control_rate_hz: robot.control.rate_hz,
        without: without.to_vec(),
        ..Settings::default()
    };
    Ok(diagnosis::diagnose(&robot.robot, runs, &settings, &Silent)?)
}

/// Opens the truth of a folder and scores the answer.
fn score_answer(
    folder: &Path,
    answer: &DiagnosisRun,
    without: &[EffectKind],
) -> Result<Score, BenchmarkError> {
    let blinded = Blinded::open(folder)?;
    let unknown = blinded.effects.iter().any(|truth| without.contains(&truth.effect));
    let score = Score::new(&answer.diagnosis, &blinded.effects, blinded.seed);
    Ok(Score { looked_for: !unknown, ..score })
}

/// Whether a folder holds all logs of this scenario: the truth is written last.
fn holds(folder: &Path, scenario: &Scenario) -> bool {
    let spec = |document: Document| document.parse::<ScenarioSpec>().ok();
    let without_robot =
        |document| spec(document).map(|spec| ScenarioSpec { robot: PathBuf::new(), ..spec });
    let there = Document::read(folder.join("scenario.toml")).ok().and_then(without_robot);
    let wanted = Document::from_text("scenario.toml", scenario.self_contained_text())
        .ok()
        .and_then(without_robot);
    folder.join(Blinded::FILE).is_file() && wanted.is_some() && there == wanted
}
