use std::path::{Path, PathBuf};

use document::{Document, KeyPath};
use learner::ModelKind;
use robot::{Loaded, Robot};
use serde::Deserialize;
use serde::de::IgnoredAny;
use simulator::scenario::{Scenario, ScenarioSpec};

use crate::error::ExperimentError;
use crate::scenario::feedforward_kind::FeedforwardKind;
use crate::scenario::tracking_scenario::{TrackingScenario, plant_of, with_plant};
use crate::scenario::tracking_spec::{
    ErrorRateSpec, LearnSpec, PredictionSpec, TrackingControlSpec, TrackingSpec,
};

/// An arm whose effects are found in some of its runs, and the gain of finding them on the others.
///
/// ```text
/// learn.train, learn.regression --diagnose, learn--> extended robot, models
/// every other run of the plant --> their errors: torque, drift of the simulation
/// motion --> their errors: tracking
/// ```
#[derive(Debug, Clone)]
pub struct Experiment {
    scenario: TrackingScenario,
    resolved: String,
    /// Whether to choose the softest gains that hold the arm.
    chooses_gains: bool,
}

/// The robot as described and the extended one, which every experiment compares.
const COMPARED: [FeedforwardKind; 2] =
    [FeedforwardKind::Model(ModelKind::Cad), FeedforwardKind::Model(ModelKind::Named)];

/// The scenario of the arm, beside the scenario that names it.
const PLANT: &str = "logs/scenario.toml";

impl Experiment {
    /// Reads a tracking scenario, or the scenario of an arm with usual values for all the rest. In the latter case
    /// nothing is learned from the last run; its motion is tracked with the softest gains of `robot.toml` that hold
    /// the arm. `seed` replaces the seed of the arm's scenario.
    ///
    /// # Errors
    ///
    /// [`ExperimentError::Document`], at the value at fault, the errors of the arm's scenario, and
    /// [`ExperimentError::NoGains`].
    pub fn from_document(document: &Document, seed: Option<u64>) -> Result<Self, ExperimentError> {
        if document.parse::<Kind>()?.plant.is_none() {
            return Self::of_arm(&with_seed(document.clone(), seed)?);
        }
        let (plant, file) = plant_of(document)?;
        let plant = Scenario::from_document(&with_seed(plant, seed)?)?;
        let document = &add_compared_models(document)?;
        let scenario = TrackingScenario::new(document, plant, file)?;
        let resolved = with_plant(document, scenario.spec(), PathBuf::from(PLANT));
        let experiment = Self { scenario, resolved, chooses_gains: false };
        if experiment.test().next().is_none() {
            let path = KeyPath::root().key("learn").key("train");
            let message = "every run of the plant is learned from, one that is not was expected: \
                           what is learned is tested on it";
            return Err(document.mistake(&path, message, None).into());
        }
        Ok(experiment)
    }

    fn of_arm(document: &Document) -> Result<Self, ExperimentError> {
        let plant = Scenario::from_document(document)?;
        // The motions of this text can be read from any folder.
        let spec: ScenarioSpec =
            Document::from_text(PLANT, plant.self_contained_text())?.parse()?;
        let (Some(test), [_, ..]) = (spec.run.last(), &spec.run[..spec.run.len() - 1]) else {
            let path = KeyPath::root().key("run");
            let message = "one run, two or more were expected: what is found in the others is \
                           tested on the last one";
            return Err(document.mistake(&path, message, None).into());
        };
        let learned = &spec.run[..spec.run.len() - 1];
        let loaded = Robot::load(plant.robot_file())?;
        let spec = TrackingSpec {
            plant: PathBuf::from(PLANT),
            motion: test.motion.clone(),
            control: TrackingControlSpec {
                gains: some_set(&loaded, plant.robot_file())?,
                kp_nm_per_rad: Default::default(),
                kd_nm_s_per_rad: Default::default(),
                error_rate: ErrorRateSpec::default(),
            },
            prediction: PredictionSpec::default(),
            learn: LearnSpec {
                train: learned.iter().map(|run| run.name.clone()).collect(),
                ..LearnSpec::default()
            },
            feedforward: COMPARED.to_vec(),
            sweep: None,
        };
        let text = toml::to_string(&spec).unwrap_or_default();
        let said = Document::from_text("scenario.toml", &text)?;
        let file = plant.robot_file().to_owned();
        let scenario = TrackingScenario::new(&said, plant, file)?;
        let scenario = scenario.with_softest_gains(&[scenario.robot()]);
        let resolved = toml::to_string(scenario.spec()).unwrap_or_default();
        Ok(Self { scenario, resolved, chooses_gains: true })
    }

    /// The scenario: the arm, the data for learning and the tracking.
    pub fn scenario(&self) -> &TrackingScenario {
        &self.scenario
    }

    /// The scenario with the hidden effects of the arm drawn, once for logs and tracking.
    ///
    /// # Errors
    ///
    /// [`ExperimentError::Simulator`] when no effect could be drawn.
    pub fn draw_scenario(&self) -> Result<TrackingScenario, ExperimentError> {
        Ok(self.scenario.of_arm(simulator::draw_hidden_effects(self.plant())?))
    }

    /// The scenario `drawn`, which has the effects of its arm, with its gains for tracking. Where no scenario states
    /// gains, they are the softest that hold the extended robot too.
    pub fn with_softest_gains(
        &self,
        drawn: &TrackingScenario,
        extended: &Robot,
    ) -> TrackingScenario {
        match self.chooses_gains {
            true => drawn.with_softest_gains(&[drawn.robot(), extended]),
            false => drawn.clone(),
        }
    }

    /// The scenario as one text that extends nothing; its arm is that of
    /// [`plant`](Self::plant), in `logs/scenario.toml` beside it.
    pub fn self_contained_text(&self) -> &str {
        &self.resolved
    }

    /// The scenario of the arm.
    pub fn plant(&self) -> &Scenario {
        self.scenario.plant()
    }

    /// The runs in which causes are found and from which models are learned.
    pub fn learning_runs(&self) -> impl Iterator<Item = &str> {
        self.names().filter(|name| self.is_learned(name))
    }

    /// The runs on which the findings are tested.
    pub fn test(&self) -> impl Iterator<Item = &str> {
        self.names().filter(|name| !self.is_learned(name))
    }

    fn names(&self) -> impl Iterator<Item = &str> {
        self.plant().runs().iter().map(|run| run.name.as_str())
    }

    fn is_learned(&self, name: &str) -> bool {
        let learn = self.scenario.learn();
        learn.train.iter().chain(&learn.regression).any(|learned| learned == name)
    }
}

/// A tracking scenario that feeds forward [`COMPARED`] first.
fn add_compared_models(document: &Document) -> Result<Document, ExperimentError> {
    let spec: TrackingSpec = document.parse()?;
    let others = spec.feedforward.iter().filter(|kind| !COMPARED.contains(kind));
    let names: Vec<String> =
        COMPARED.iter().chain(others).map(|kind| format!("{:?}", kind.name())).collect();
    let given = &spec.feedforward;
    // A name that is there twice is refused where it stands.
    let is_repeated = (1..given.len()).any(|n| given[..n].contains(&given[n]));
    let mut document = document.clone();
    if !is_repeated && COMPARED.iter().any(|kind| !given.contains(kind)) {
        document.set(&format!("feedforward=[{}]", names.join(", ")))?;
    }
    Ok(document)
}

/// The key that tells a tracking scenario from the scenario of an arm.
#[derive(Deserialize)]
struct Kind {
    plant: Option<IgnoredAny>,
}

/// The document with its seed replaced by `seed`, if there is one.
///
/// # Errors
///
/// [`ExperimentError::Document`] when the document cannot take the seed.
pub fn with_seed(mut document: Document, seed: Option<u64>) -> Result<Document, ExperimentError> {
    if let Some(seed) = seed {
        document.set(&format!("seed={seed}"))?;
    }
    Ok(document)
}

/// Any set of gains of the robot, until the set that holds the arm is known.
fn some_set(loaded: &Loaded, file: &Path) -> Result<String, ExperimentError> {
    let name = loaded.control.gain_sets.keys().next().cloned();
    name.ok_or_else(|| ExperimentError::NoGains { path: file.to_owned() })
}
