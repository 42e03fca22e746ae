use std::cell::OnceCell;
use std::path::{Path, PathBuf};

use experiment::{
    Blinded, DiagnosedLogs, Experiment, ForwardGap, Learned, Metrics, Outputs, Product, Score,
    StageInputs, Staged, TorqueError, TrackedError, TrackedRun, TrackingScenario, forward_gap,
    torque_errors, track_all, tracking_claims,
};
use logs::{PrepareSettings, Run};
use recording::Live;
use report::{DiagnosisSummary, TrackedModel, TrackingComparison};
use robot::{Loaded, Robot};
use serde::{Deserialize, Serialize};

use super::run_folder::{self, DiagnosedRuns, RunFolder, diagnosis_files};
use crate::commands::diagnose;
use crate::commands::track::comparison::{comparison, problems};
use crate::commands::track::tracking_result::write_comparison;
use crate::error::CliError;
use crate::output::create_folder;
use crate::watch::Watch;

const LOGS: &str = "logs";
const DIAGNOSIS: &str = "diagnosis";
const EXTENDED: &str = "diagnosis/extended.toml";
const RECORDING: &str = "recording.rrd";
const MODELS: &str = "models";
const TRACKING: &str = "tracking";

/// The stages of a run, each of which is made from what those before it have written.
pub struct Stages<'a> {
    pub experiment: &'a Experiment,
    /// Folder of the run.
    pub out: &'a Path,
    /// The file of the scenario.
    pub scenario: &'a Path,
    pub watch: &'a Watch,
    /// The scenario with the effects of its arm drawn, when that was done.
    pub drawn: OnceCell<TrackingScenario>,
}

/// What the report shows beside the numbers.
pub struct Shown {
    /// The diagnosis.
    pub diagnosis: DiagnosisSummary,
    /// The beginning of the motion that was tracked.
    pub motion: String,
}

/// What the diagnosis leaves for later stages.
#[derive(Serialize, Deserialize)]
struct Found {
    told: DiagnosisSummary,
    score: Score,
}

/// What the tracking leaves for the report.
#[derive(Serialize, Deserialize)]
struct Tracked {
    /// Name of the gains.
    gains: String,
    errors: Vec<TrackedError>,
    motion: String,
}

impl Stages<'_> {
    /// Makes every stage that is not there yet.
    pub fn all(&self) -> Result<(Metrics, Shown), CliError> {
        self.logs()?;
        let Staged { value: Found { told, score }, .. } = self.diagnosis()?;
        let torque = self.models()?.value;
        let forward = self.forward()?.value;
        let Staged { value: tracked, .. } = self.tracking()?;
        let experiment = self.experiment;
        let to_owned_names =
            |names: &mut dyn Iterator<Item = &str>| names.map(str::to_owned).collect();
        let robot = experiment.plant().robot();
        let joints: Vec<String> = robot.joint_names().map(str::to_owned).collect();
        let metrics = Metrics {
            robot: robot.name().to_owned(),
            claims: tracking_claims(&tracked.errors, &joints),
            joints,
            score,
            learned: to_owned_names(&mut experiment.learning_runs()),
            test: to_owned_names(&mut experiment.test()),
            torque,
            forward,
            gains: tracked.gains,
            tracking: tracked.errors,
        };
        Ok((metrics, Shown { diagnosis: told, motion: tracked.motion }))
    }

    /// Simulates the logs and, apart from them, the truth.
    fn logs(&self) -> Result<Staged<()>, CliError> {
        let plant = self.experiment.plant();
        let drawn = || Ok(self.drawn_scenario()?.plant());
        self.folder().logs("simulation", Path::new(LOGS), plant, self.loaded_robot(), drawn)
    }

    /// Diagnoses the logs through their files, and when that is written opens the truth.
    fn diagnosis(&self) -> Result<Staged<Found>, CliError> {
        let names: Vec<&str> = self.experiment.learning_runs().collect();
        let mut inputs = self.inputs("")?.and_file(&self.out.join(LOGS).join(Blinded::FILE))?;
        for name in &names {
            inputs = inputs.and(name.as_bytes()).and_file(&self.out.join(log_file(name)))?;
        }
        let words = format!("from {} of the logs alone", names.len());
        self.stage("diagnosis", &words, inputs, || {
            let loaded = self.loaded_robot();
            let runs = self.runs(&names)?;
            let robot_file = self.experiment.plant().robot_file();
            let DiagnosedRuns { outcome, verdict, told } =
                self.folder().diagnose(Path::new(DIAGNOSIS), robot_file, loaded, &runs)?;
            let diagnosed =
                DiagnosedLogs { loaded, runs: &runs, outcome: &outcome, verdict: &verdict };
            if recording::IS_BUILT {
                diagnose::write_recording(self.out, &diagnosed, self.watch)
                    .map_err(|error| *error)?;
            }
            let blinded = Blinded::open(&self.out.join(LOGS))?;
            let score = Score::new(&outcome.diagnosis, &blinded.effects, blinded.seed);
            let mut files = diagnosis_files(Path::new(DIAGNOSIS));
            files.extend(recording::IS_BUILT.then(|| PathBuf::from(RECORDING)));
            Ok(Product { value: Found { told, score }, files })
        })
    }

    /// Learns the models that the scenario feeds forward, and tests their torque.
    fn models(&self) -> Result<Staged<Vec<TorqueError>>, CliError> {
        let tracked = self.experiment.scenario();
        let test: Vec<&str> = self.experiment.test().collect();
        let learned: Vec<&str> = self.experiment.learning_runs().collect();
        let mut inputs = self.inputs(&format!("{:?}", tracked.learn()))?;
        inputs = inputs.and(format!("{:?}", tracked.all_feedforward()).as_bytes());
        inputs = inputs.and_file(&self.out.join(EXTENDED))?;
        for name in learned.iter().chain(&test) {
            inputs = inputs.and(name.as_bytes()).and_file(&self.out.join(log_file(name)))?;
        }
        let words = format!("torque of {} held out", test.join(", "));
        self.stage("models", &words, inputs, || {
            let extended = self.extended_robot()?;
            let logs = self.runs(&learned)?;
            let models = Learned::learn(tracked, &logs, Some(&extended), self.watch)?;
            let folder = self.out.join(MODELS);
            create_folder(&folder)?;
            models.save(&folder)?;
            let errors = torque_errors(tracked, &models, &self.runs(&test)?)?;
            let files = errors.iter().map(|error| format!("{MODELS}/{}.parquet", error.model));
            Ok(Product { files: files.map(PathBuf::from).collect(), value: errors })
        })
    }

    /// Rolls both simulations forward under the torque of the runs that were held out.
    fn forward(&self) -> Result<Staged<ForwardGap>, CliError> {
        let test: Vec<&str> = self.experiment.test().collect();
        let mut inputs = self.inputs("")?.and_file(&self.out.join(EXTENDED))?;
        for name in &test {
            inputs = inputs.and_file(&self.out.join(log_file(name)))?;
        }
        let words = format!("simulation under the torque of {}", test.join(", "));
        self.stage("replay", &words, inputs, || {
            let prepared = logs::prepare(&self.runs(&test)?, &PrepareSettings::default())?;
            let robots = [self.experiment.plant().robot(), &self.extended_robot()?];
            let gap = forward_gap(robots, &prepared.runs, self.watch);
            Ok(Product { value: gap, files: Vec::new() })
        })
    }

    /// Tracks the motion of the scenario with every model.
    fn tracking(&self) -> Result<Staged<Tracked>, CliError> {
        let tracked = self.experiment.scenario();
        let mut inputs = self.inputs(self.experiment.self_contained_text())?;
        inputs = inputs.and(self.experiment.plant().self_contained_text().as_bytes());
        let kinds = tracked.all_feedforward();
        for kind in kinds.iter().filter_map(|kind| kind.model()) {
            inputs = inputs.and_file(&self.out.join(MODELS).join(format!("{kind}.parquet")))?;
        }
        let words = format!("{} feedforwards", kinds.len());
        self.stage("tracking", &words, inputs, || {
            let folder = self.out.join(TRACKING);
            let logs = folder.join("logs");
            let recordings = recording::IS_BUILT.then(|| folder.join("recordings"));
            for folder in std::iter::once(&logs).chain(&recordings) {
                create_folder(folder)?;
            }
            let learned = Learned::load(tracked, &self.out.join(MODELS))?;
            let outputs = Outputs { logs, recordings, live: Live::Off };
            let scenario =
                self.experiment.with_softest_gains(self.drawn_scenario()?, &self.extended_robot()?);
            let runs = track_all(&scenario, &learned, Some(&outputs), self.watch)?;
            self.write_tracking(&scenario, &learned, &runs)
        })
    }

    /// Writes the comparison of the runs.
    fn write_tracking(
        &self,
        scenario: &TrackingScenario,
        learned: &Learned,
        runs: &[TrackedRun],
    ) -> Result<Product<Tracked>, CliError> {
        let swept = experiment::sweep(scenario, learned, self.watch)?;
        let comparison = comparison(self.scenario, scenario, runs, swept.as_ref())?;
        write_comparison(&self.out.join(TRACKING), scenario, &comparison)?;
        if let Some(problem) = problems(runs).next() {
            return Err(CliError::Incomplete { problem: problem.clone() });
        }
        let pages = ["report.html", "tracking.json"].map(|name| Path::new(TRACKING).join(name));
        let runs_files = runs.iter().flat_map(|run| {
            let recording = recording::IS_BUILT.then(|| format!("recordings/{}.rrd", run.kind));
            std::iter::once(format!("logs/{}.parquet", run.kind)).chain(recording)
        });
        let runs_files = runs_files.map(|name| Path::new(TRACKING).join(name));
        let errors = runs.iter().map(TrackedError::of).collect();
        let gains = scenario.gains_name().to_owned();
        let value =
            Tracked { gains, errors, motion: with_page_names(comparison).motion_in_page()? };
        Ok(Product { value, files: pages.into_iter().chain(runs_files).collect() })
    }

    fn folder(&self) -> RunFolder<'_> {
        RunFolder { out: self.out, watch: self.watch }
    }

    fn stage<T: Serialize + for<'de> Deserialize<'de>>(
        &self,
        name: &str,
        words: &str,
        inputs: StageInputs,
        make: impl FnOnce() -> Result<Product<T>, CliError>,
    ) -> Result<Staged<T>, CliError> {
        self.folder().stage(name, words, inputs, make)
    }

    fn inputs(&self, said: &str) -> Result<StageInputs, CliError> {
        RunFolder::inputs(self.experiment.plant().robot_file(), self.loaded_robot(), said)
    }

    fn drawn_scenario(&self) -> Result<&TrackingScenario, CliError> {
        match self.drawn.get() {
            Some(drawn) => Ok(drawn),
            None => {
                experiment::Progress::begin(self.watch, "drawing what is hidden");
                let drawn = self.experiment.draw_scenario()?;
                Ok(self.drawn.get_or_init(|| drawn))
            }
        }
    }

    fn loaded_robot(&self) -> &Loaded {
        self.experiment.scenario().loaded_robot()
    }

    /// The robot with the findings, as it was written.
    fn extended_robot(&self) -> Result<Robot, CliError> {
        Ok(Robot::load(&self.out.join(EXTENDED))?.robot)
    }

    /// Logs, read from their files.
    fn runs(&self, names: &[&str]) -> Result<Vec<Run>, CliError> {
        self.folder().runs(Path::new(LOGS), names, &self.loaded_robot().robot)
    }
}

/// The runs with the robot as described and with the extended one alone, under the names that they have
/// wherever a page compares the two.
fn with_page_names(comparison: TrackingComparison) -> TrackingComparison {
    let named = [("named", "extended"), ("cad", "nominal")].into_iter();
    let models = named.filter_map(|(kind, name)| {
        let run = comparison.models.iter().find(|model| model.name == kind)?;
        Some(TrackedModel { name: name.to_owned(), ..run.clone() })
    });
    TrackingComparison { models: models.collect(), ..comparison.clone() }
}

/// The log of a run, relative to the folder.
fn log_file(run: &str) -> PathBuf {
    run_folder::log_file(Path::new(LOGS), run)
}
