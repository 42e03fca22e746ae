use std::cell::OnceCell;
use std::path::{Path, PathBuf};
use std::time::Instant;

use diagnosis::Settings;
use evaluation::{
    Diagnosed, Experiment, ForwardGap, Inputs, Learned, Metrics, Outputs, Product, Score, Sealed,
    Stage, Staged, TorqueError, TrackedError, TrackedRun, TrackingScenario, forward_gap,
    record_diagnosis, torque_errors, track_all,
};
use logs::{PrepareSettings, ReadOptions, Run};
use recording::Live;
use report::{Report, Told, TrackedModel, TrackingComparison};
use robot::{Loaded, Robot};
use serde::{Deserialize, Serialize};
use simulator::LogFormat;

use crate::commands::{diagnose, track};
use crate::error::CliError;
use crate::input::{hashes_of, provenance};
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
    pub diagnosis: Told,
    /// The beginning of the motion that was tracked.
    pub motion: String,
}

/// What the diagnosis leaves for later stages.
#[derive(Serialize, Deserialize)]
struct Found {
    told: Told,
    score: Score,
}

/// What the tracking leaves for the report.
#[derive(Serialize, Deserialize)]
struct Tracked {
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
        let owned = |names: &mut dyn Iterator<Item = &str>| names.map(str::to_owned).collect();
        let robot = experiment.plant().robot();
        let metrics = Metrics {
            robot: robot.name().to_owned(),
            joints: robot.joint_names().map(str::to_owned).collect(),
            score,
            learned: owned(&mut experiment.learned()),
            test: owned(&mut experiment.test()),
            torque,
            forward,
            gains: experiment.scenario().gains_name().to_owned(),
            tracking: tracked.errors,
        };
        Ok((metrics, Shown { diagnosis: told, motion: tracked.motion }))
    }

    /// Simulates the logs and, apart from them, the truth.
    fn logs(&self) -> Result<Staged<()>, CliError> {
        let plant = self.experiment.plant();
        let mut inputs = self.inputs(plant.resolved())?;
        for run in plant.runs() {
            // A recorded motion may change where its name does not.
            for k in 0..=(100.0 * run.motion.duration_s()) as usize {
                let q = run.motion.at(0.01 * k as f64).q;
                inputs = q.iter().fold(inputs, |inputs, q| inputs.and(&q.to_le_bytes()));
            }
        }
        let seconds: f64 = plant.runs().iter().map(|run| run.motion.duration_s()).sum();
        let words = format!("{} runs, {seconds:.0} s of motion", plant.runs().len());
        self.stage("simulation", &words, inputs, || {
            create_folder(&self.out.join(LOGS))?;
            evaluation::Progress::begin(
                self.watch,
                &format!("simulating {seconds:.0} s of motion"),
            );
            let second = || evaluation::Progress::second(self.watch);
            let simulation = simulator::simulate(self.drawn()?.plant(), &second)?;
            simulator::write(&self.out.join(LOGS), plant, &simulation, LogFormat::Parquet)?;
            let logs = plant.runs().iter().map(|run| log_file(&run.name));
            let others = ["scenario.toml", Sealed::FILE].map(|name| Path::new(LOGS).join(name));
            Ok(Product { value: (), files: logs.chain(others).collect() })
        })
    }

    /// Diagnoses the logs through their files, and when that is written opens the truth.
    fn diagnosis(&self) -> Result<Staged<Found>, CliError> {
        let names: Vec<&str> = self.experiment.learned().collect();
        let mut inputs = self.inputs("")?.and_file(&self.out.join(LOGS).join(Sealed::FILE))?;
        for name in &names {
            inputs = inputs.and(name.as_bytes()).and_file(&self.out.join(log_file(name)))?;
        }
        let words = format!("from {} of the logs alone", names.len());
        self.stage("diagnosis", &words, inputs, || {
            let (loaded, file) = (self.loaded(), self.experiment.plant().robot_file());
            let runs = self.runs(&names)?;
            let settings =
                Settings { control_rate_hz: loaded.control.rate_hz, ..Settings::default() };
            let outcome = diagnosis::diagnose(&loaded.robot, &runs, &settings, self.watch)?;
            let mut provenance = provenance(file, loaded, None)?;
            provenance.files.extend(hashes_of(&runs));
            provenance.seed = Some(settings.seed);
            let report = Report::new(&outcome, &loaded.robot, &provenance);
            let json = report::json(&report)?;
            let folder = self.out.join(DIAGNOSIS);
            diagnose::write(&folder, loaded, &outcome, (&report, &json), None)?;
            let verdict = &report::markdown(&report);
            let diagnosed = Diagnosed { loaded, runs: &runs, outcome: &outcome, verdict };
            record_diagnosis(&self.out.join(RECORDING), &diagnosed, self.watch)?;
            let sealed = Sealed::open(&self.out.join(LOGS))?;
            let score = Score::new(&outcome.diagnosis, &sealed.effects, sealed.seed);
            let files =
                ["report.html", "figure.svg", "diagnosis.json", "extended.toml", "robot.urdf"];
            let files = files.map(|name| Path::new(DIAGNOSIS).join(name));
            let files = files.into_iter().chain([PathBuf::from(RECORDING)]).collect();
            Ok(Product { value: Found { told: report::told(&report)?, score }, files })
        })
    }

    /// Learns the models that the scenario feeds forward, and tests their torque.
    fn models(&self) -> Result<Staged<Vec<TorqueError>>, CliError> {
        let tracked = self.experiment.scenario();
        let test: Vec<&str> = self.experiment.test().collect();
        let learned: Vec<&str> = self.experiment.learned().collect();
        let mut inputs = self.inputs(&format!("{:?}", tracked.learn()))?;
        inputs = inputs.and(format!("{:?}", tracked.all_feedforward()).as_bytes());
        inputs = inputs.and_file(&self.out.join(EXTENDED))?;
        for name in learned.iter().chain(&test) {
            inputs = inputs.and(name.as_bytes()).and_file(&self.out.join(log_file(name)))?;
        }
        let words = format!("torque of {} held out", test.join(", "));
        self.stage("models", &words, inputs, || {
            let extended = self.extended()?;
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
            let robots = [self.experiment.plant().robot(), &self.extended()?];
            let gap = forward_gap(robots, &prepared.runs, self.watch);
            Ok(Product { value: gap, files: Vec::new() })
        })
    }

    /// Tracks the motion of the scenario with every model.
    fn tracking(&self) -> Result<Staged<Tracked>, CliError> {
        let tracked = self.experiment.scenario();
        let mut inputs = self.inputs(self.experiment.resolved())?;
        inputs = inputs.and(self.experiment.plant().resolved().as_bytes());
        let kinds = tracked.all_feedforward();
        for kind in kinds.iter().filter_map(|kind| kind.model()) {
            inputs = inputs.and_file(&self.out.join(MODELS).join(format!("{kind}.parquet")))?;
        }
        let words = format!("{} feedforwards, gains {}", kinds.len(), tracked.gains_name());
        self.stage("tracking", &words, inputs, || {
            let folder = self.out.join(TRACKING);
            let (logs, recordings) = (folder.join("logs"), folder.join("recordings"));
            create_folder(&logs)?;
            create_folder(&recordings)?;
            let learned = Learned::load(tracked, &self.out.join(MODELS))?;
            let outputs = Outputs { logs, recordings, live: Live::Off };
            let drawn = self.drawn()?;
            let runs = track_all(drawn, &learned, Some(&outputs), self.watch)?;
            self.tracked(drawn, &learned, &runs)
        })
    }

    /// Writes the comparison of the runs.
    fn tracked(
        &self,
        scenario: &TrackingScenario,
        learned: &Learned,
        runs: &[TrackedRun],
    ) -> Result<Product<Tracked>, CliError> {
        let swept = evaluation::sweep(scenario, learned, self.watch)?;
        let comparison = track::comparison(self.scenario, scenario, runs, swept.as_ref())?;
        track::write(&self.out.join(TRACKING), scenario, &comparison)?;
        if let Some(problem) = track::problems(runs).next() {
            return Err(CliError::Incomplete { problem: problem.clone() });
        }
        let pages = ["report.html", "tracking.json"].map(|name| Path::new(TRACKING).join(name));
        let runs_files = runs.iter().flat_map(|run| {
            [format!("logs/{}.parquet", run.kind), format!("recordings/{}.rrd", run.kind)]
        });
        let runs_files = runs_files.map(|name| Path::new(TRACKING).join(name));
        let errors = runs.iter().map(TrackedError::of).collect();
        let value = Tracked { errors, motion: compared(comparison).motion_in_page()? };
        Ok(Product { value, files: pages.into_iter().chain(runs_files).collect() })
    }

    /// What a stage of this name has made or makes, and a line that says so.
    fn stage<T: Serialize + for<'de> Deserialize<'de>>(
        &self,
        name: &str,
        words: &str,
        inputs: Inputs,
        make: impl FnOnce() -> Result<Product<T>, CliError>,
    ) -> Result<Staged<T>, CliError> {
        let start = Instant::now();
        let made = Stage::new(self.out, name).make(inputs, make)?;
        let time = match made.is_kept {
            true => "made before".to_owned(),
            false => format!("{:.1} s", start.elapsed().as_secs_f64()),
        };
        self.watch.leave(&format!("{name:<12} {words:<50} {time:>12}"));
        Ok(made)
    }

    /// What every stage depends on: the program, the robot and something said.
    fn inputs(&self, said: &str) -> Result<Inputs, CliError> {
        let (loaded, file) = (self.loaded(), self.experiment.plant().robot_file());
        let inputs = Inputs::of(env!("CARGO_PKG_VERSION")).and(said.as_bytes());
        Ok(inputs.and_file(file)?.and_file(&loaded.urdf_path)?)
    }

    fn drawn(&self) -> Result<&TrackingScenario, CliError> {
        match self.drawn.get() {
            Some(drawn) => Ok(drawn),
            None => {
                evaluation::Progress::begin(self.watch, "drawing what is hidden");
                let drawn = self.experiment.drawn()?;
                Ok(self.drawn.get_or_init(|| drawn))
            }
        }
    }

    fn loaded(&self) -> &Loaded {
        self.experiment.scenario().loaded()
    }

    /// The robot with the findings, as it was written.
    fn extended(&self) -> Result<Robot, CliError> {
        Ok(Robot::load(&self.out.join(EXTENDED))?.robot)
    }

    /// Logs, read from their files.
    fn runs(&self, names: &[&str]) -> Result<Vec<Run>, CliError> {
        let options = ReadOptions { map: None, effort: "effort" };
        let read = |name: &&str| {
            logs::read_run(&self.out.join(log_file(name)), &self.loaded().robot, &options)
        };
        Ok(names.iter().map(read).collect::<Result<_, _>>()?)
    }
}

/// The runs with the robot as described and with the extended one alone: the first two colours are
/// blue and orange, which mean extended and nominal wherever a page compares the two.
fn compared(comparison: TrackingComparison) -> TrackingComparison {
    let named = [("named", "extended"), ("cad", "nominal")].into_iter();
    let models = named.filter_map(|(kind, name)| {
        let run = comparison.models.iter().find(|model| model.name == kind)?;
        Some(TrackedModel { name: name.to_owned(), ..run.clone() })
    });
    TrackingComparison { models: models.collect(), ..comparison.clone() }
}

/// The log of a run, relative to the folder.
fn log_file(run: &str) -> PathBuf {
    Path::new(LOGS).join(format!("{run}.{}", LogFormat::Parquet.extension()))
}
