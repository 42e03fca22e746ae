use std::path::{Path, PathBuf};

use document::{Document, DocumentError, KeyPath};
use motion::{Motion, MotionSpec};
use robot::{Loaded, PdGain, Robot};
use simulator::scenario::Scenario;

use crate::error::ExperimentError;
use crate::scenario::feedforward_kind::FeedforwardKind;
use crate::scenario::tracking_spec::{
    ErrorRateSpec, LearnSpec, PredictionSpec, PredictionTimeSpec, SweepSpec, TrackingSpec,
};

/// A tracking scenario whose values are checked: ready to run.
#[derive(Debug, Clone)]
pub struct TrackingScenario {
    spec: TrackingSpec,
    plant: Scenario,
    plant_file: PathBuf,
    loaded: Loaded,
    motion: Motion,
    gains: Vec<PdGain>,
    swept_gains: Vec<PdGain>,
    resolved: String,
}

impl TrackingScenario {
    /// Reads a tracking scenario from a document.
    ///
    /// # Errors
    ///
    /// [`ExperimentError::Document`], at the value at fault, and the errors of the plant's scenario.
    pub fn from_document(document: &Document) -> Result<Self, ExperimentError> {
        let (plant, plant_file) = plant_of(document)?;
        Self::new(document, Scenario::from_document(&plant)?, plant_file)
    }

    /// Reads a tracking scenario from a document, whose plant was read from `plant_file`.
    pub(crate) fn new(
        document: &Document,
        plant: Scenario,
        plant_file: PathBuf,
    ) -> Result<Self, ExperimentError> {
        let spec: TrackingSpec = document.parse()?;
        let loaded = Robot::load(plant.robot_file())?;
        let check = Checker { document, spec: &spec, plant: &plant, loaded: &loaded };
        let gains = check.gains()?;
        check.error_rate()?;
        check.prediction()?;
        check.feedforward()?;
        check.learn()?;
        let swept_gains = check.sweep()?;
        let motion = check.motion()?;
        let resolved = resolve(document, &spec);
        Ok(Self { spec, plant, plant_file, loaded, motion, gains, swept_gains, resolved })
    }

    /// The scenario for an arm that differs in its effects only.
    pub(crate) fn of_arm(&self, plant: Scenario) -> Self {
        Self { plant, ..self.clone() }
    }

    /// The scenario with the softest gains of `robot.toml` that hold all these robots against gravity along the
    /// motion ([`tracking::holds`]), or with the stiffest where none hold them.
    pub(crate) fn with_softest_gains(&self, robots: &[&Robot]) -> Self {
        let mut sets: Vec<(&String, &Vec<PdGain>)> = self.loaded.control.gain_sets.iter().collect();
        let stiffness = |gains: &[PdGain]| gains.iter().map(|gain| gain.kp).sum::<f64>();
        sets.sort_by(|a, b| stiffness(a.1).total_cmp(&stiffness(b.1)));
        let holds = |gains: &[PdGain]| {
            robots.iter().all(|robot| tracking::holds(robot, gains, &self.motion))
        };
        let softest = sets.iter().find(|(_, gains)| holds(gains)).or(sets.last());
        softest.map_or_else(|| self.clone(), |(name, gains)| self.with_gains(name, gains))
    }

    /// The scenario with the set of gains of this name.
    fn with_gains(&self, name: &str, gains: &[PdGain]) -> Self {
        let mut scenario = Self { gains: gains.to_vec(), ..self.clone() };
        name.clone_into(&mut scenario.spec.control.gains);
        let resolved = Document::from_text("scenario.toml", &self.resolved);
        if let Ok(mut resolved) = resolved.and_then(|text| text.parse::<TrackingSpec>()) {
            name.clone_into(&mut resolved.control.gains);
            scenario.resolved = toml::to_string(&resolved).unwrap_or_default();
        }
        scenario
    }

    /// The scenario as it was written.
    pub(crate) fn spec(&self) -> &TrackingSpec {
        &self.spec
    }

    /// The scenario as one text that extends nothing and can be read from any folder.
    pub fn self_contained_text(&self) -> &str {
        &self.resolved
    }

    /// The arm that is tracked.
    pub fn plant(&self) -> &Scenario {
        &self.plant
    }

    /// The file of the arm's scenario.
    pub fn plant_file(&self) -> &Path {
        &self.plant_file
    }

    /// The robot as described, with its looks and gains.
    pub fn loaded_robot(&self) -> &Loaded {
        &self.loaded
    }

    /// The robot as described.
    pub fn robot(&self) -> &Robot {
        &self.loaded.robot
    }

    /// The motion that is tracked.
    pub fn motion(&self) -> &Motion {
        &self.motion
    }

    /// Gains of the feedback, one a joint.
    pub fn gains(&self) -> &[PdGain] {
        &self.gains
    }

    /// Name of the set of gains.
    pub fn gains_name(&self) -> &str {
        &self.spec.control.gains
    }

    /// Where the rate of the error comes from.
    pub fn error_rate(&self) -> ErrorRateSpec {
        self.spec.control.error_rate
    }

    /// How predictions reach the loop.
    pub fn prediction(&self) -> &PredictionSpec {
        &self.spec.prediction
    }

    /// The data that models are learned from.
    pub fn learn(&self) -> &LearnSpec {
        &self.spec.learn
    }

    /// What is fed forward, run by run.
    pub fn feedforward(&self) -> &[FeedforwardKind] {
        &self.spec.feedforward
    }

    /// The range of gains, and the set of gains that it scales.
    pub fn sweep(&self) -> Option<(&SweepSpec, &[PdGain])> {
        Some((self.spec.sweep.as_ref()?, &self.swept_gains))
    }

    /// Every feedforward of the runs and the sweep, each once.
    pub fn all_feedforward(&self) -> Vec<FeedforwardKind> {
        let swept = self.spec.sweep.iter().flat_map(|sweep| &sweep.feedforward);
        let mut all = Vec::new();
        for kind in self.spec.feedforward.iter().chain(swept) {
            if !all.contains(kind) {
                all.push(*kind);
            }
        }
        all
    }
}

/// The document of a tracking scenario's plant, and its file.
pub(crate) fn plant_of(document: &Document) -> Result<(Document, PathBuf), ExperimentError> {
    let spec: TrackingSpec = document.parse()?;
    document_at(document, &KeyPath::root().key("plant"), &spec.plant)
}

/// The document in the file that a value of `document` names, and that file.
///
/// # Errors
///
/// [`ExperimentError::Document`], at the value.
pub fn document_at(
    document: &Document,
    key: &KeyPath,
    named: &Path,
) -> Result<(Document, PathBuf), ExperimentError> {
    Ok(document.read_named(key, named)?)
}

/// Refuses a list of runs in a document that names a run unknown to the plant.
///
/// # Errors
///
/// [`ExperimentError::Document`], at the name.
pub fn known_runs(
    document: &Document,
    list: &KeyPath,
    named: &[String],
    plant: &Scenario,
) -> Result<(), DocumentError> {
    let names: Vec<&str> = plant.runs().iter().map(|run| run.name.as_str()).collect();
    match named.iter().position(|name| !names.contains(&name.as_str())) {
        None => Ok(()),
        Some(i) => {
            Err(document.unknown_name(&list.index(i), "run of the plant", &named[i], &names))
        }
    }
}

/// The motion at a path of a document.
///
/// # Errors
///
/// [`ExperimentError::Document`], at the motion.
pub fn motion_at(
    document: &Document,
    path: &KeyPath,
    spec: &MotionSpec,
    robot: &Robot,
) -> Result<Motion, DocumentError> {
    spec.build(robot, document.directory_of(path)).map_err(|error| {
        let inside: KeyPath = error.key().parse().unwrap_or_else(|_| KeyPath::root());
        let segments = path.segments().iter().chain(inside.segments()).cloned();
        document.mistake(&segments.collect(), error.to_string(), None)
    })
}

/// The file of the plant, as a path that holds in any folder.
fn resolve(document: &Document, spec: &TrackingSpec) -> String {
    let folder = document.directory_of(&KeyPath::root().key("plant"));
    let plant = folder.join(&spec.plant);
    with_plant(document, spec, plant.canonicalize().unwrap_or(plant))
}

/// The scenario as one text that extends nothing, its plant in `plant`.
pub(crate) fn with_plant(document: &Document, spec: &TrackingSpec, plant: PathBuf) -> String {
    let mut spec = TrackingSpec { plant, ..spec.clone() };
    spec.motion.anchor(document.directory_of(&KeyPath::root().key("motion")));
    toml::to_string(&spec).unwrap_or_else(|_| document.to_toml())
}

struct Checker<'a> {
    document: &'a Document,
    spec: &'a TrackingSpec,
    plant: &'a Scenario,
    loaded: &'a Loaded,
}

impl Checker<'_> {
    fn mistake(&self, path: &KeyPath, message: impl Into<String>) -> DocumentError {
        self.document.mistake(path, message, None)
    }

    fn within(
        &self,
        path: &KeyPath,
        value: f64,
        [low, high]: [f64; 2],
    ) -> Result<(), DocumentError> {
        if value >= low && value <= high {
            return Ok(());
        }
        Err(self.mistake(path, format!("{value}, a number from {low} to {high} was expected")))
    }

    fn gain_set(&self, path: &KeyPath, name: &str) -> Result<Vec<PdGain>, DocumentError> {
        let sets = &self.loaded.control.gain_sets;
        sets.get(name).cloned().ok_or_else(|| {
            let names: Vec<&str> = sets.keys().map(String::as_str).collect();
            self.document.unknown_name(path, "set of gains", name, &names)
        })
    }

    fn gains(&self) -> Result<Vec<PdGain>, DocumentError> {
        let control = &self.spec.control;
        let path = KeyPath::root().key("control");
        let mut gains = self.gain_set(&path.key("gains"), &control.gains)?;
        let names: Vec<&str> = self.loaded.robot.joint_names().collect();
        for (key, map) in [
            ("kp_nm_per_rad", &control.kp_nm_per_rad),
            ("kd_nm_s_per_rad", &control.kd_nm_s_per_rad),
        ] {
            for (name, &value) in map {
                let path = path.key(key).key(name.clone());
                let Some(joint) = self.loaded.robot.joint_index(name) else {
                    return Err(self.document.unknown_name(&path, "joint", name, &names));
                };
                self.within(&path, value, [0.0, 1e6])?;
                let gain = &mut gains[joint];
                if key == "kp_nm_per_rad" { gain.kp = value } else { gain.kd = value }
            }
        }
        Ok(gains)
    }

    fn error_rate(&self) -> Result<(), DocumentError> {
        let ErrorRateSpec::FilteredDifference { cutoff_hz } = self.spec.control.error_rate else {
            return Ok(());
        };
        let path = ["control", "error_rate", "filtered_difference", "cutoff_hz"];
        let path = path.iter().fold(KeyPath::root(), |path, key| path.key(*key));
        self.within(&path, cutoff_hz, [0.1, 1e4])
    }

    fn prediction(&self) -> Result<(), DocumentError> {
        let path = KeyPath::root().key("prediction");
        if let PredictionTimeSpec::Given(time_ms) = self.spec.prediction.time_ms {
            self.within(&path.key("time_ms"), time_ms, [0.0, 1e4])?;
        }
        match self.spec.prediction.stops_at_s {
            Some(stop_s) => self.within(&path.key("stops_at_s"), stop_s, [0.0, 1e6]),
            None => Ok(()),
        }
    }

    fn feedforward(&self) -> Result<(), DocumentError> {
        let path = KeyPath::root().key("feedforward");
        let kinds = &self.spec.feedforward;
        if kinds.is_empty() {
            return Err(self.mistake(&path, "nothing, at least one was expected, such as \"rbd\""));
        }
        let twice = (0..kinds.len()).find(|&i| kinds[..i].contains(&kinds[i]));
        match twice {
            Some(i) => Err(self.mistake(&path.index(i), format!("{} is there already", kinds[i]))),
            None => Ok(()),
        }
    }

    fn learn(&self) -> Result<(), DocumentError> {
        let path = KeyPath::root().key("learn");
        let learn = &self.spec.learn;
        for (key, runs) in [("train", &learn.train), ("regression", &learn.regression)] {
            known_runs(self.document, &path.key(key), runs, self.plant)?;
        }
        if learn.points == 0 {
            return Err(self.mistake(&path.key("points"), "0, at least one was expected"));
        }
        Ok(())
    }

    fn sweep(&self) -> Result<Vec<PdGain>, DocumentError> {
        let Some(sweep) = &self.spec.sweep else { return Ok(Vec::new()) };
        let path = KeyPath::root().key("sweep");
        let gains = self.gain_set(&path.key("gains"), &sweep.gains)?;
        if sweep.scales.len() < 2 || !sweep.scales.is_sorted_by(|a, b| a < b) {
            let message = format!("{:?}, two or more rising factors were expected", sweep.scales);
            return Err(self.mistake(&path.key("scales"), message));
        }
        for (i, &scale) in sweep.scales.iter().enumerate() {
            self.within(&path.key("scales").index(i), scale, [1e-4, 1e4])?;
        }
        if sweep.feedforward.is_empty() {
            let message = "nothing, at least one was expected, such as \"rbd\"";
            return Err(self.mistake(&path.key("feedforward"), message));
        }
        if let Some(duration_s) = sweep.duration_s {
            self.within(&path.key("duration_s"), duration_s, [0.1, 1e6])?;
        }
        Ok(gains)
    }

    fn motion(&self) -> Result<Motion, DocumentError> {
        let path = KeyPath::root().key("motion");
        motion_at(self.document, &path, &self.spec.motion, &self.loaded.robot)
    }
}
