use std::path::{Path, PathBuf};

use document::{Document, DocumentError, KeyPath};
use dynamics::ColumnSet;
use experiment::{
    Learned, Lesson, PAPER_MODELS, Progress, document_at, known_runs, motion_at, with_seed,
};
use logs::Run;
use motion::Motion;
use robot::{Loaded, Robot};
use simulator::scenario::{RunSpec, Scenario, ScenarioSpec};

use crate::error::BenchmarkError;
use crate::paper::figure_spec::{DataSpec, FigureScenario, FigureSpec, LearningFigureSpec};
use crate::paper::learning_errors::ModelErrors;

/// The rigid bodies of the figure: the links and the rotors.
const RIGID_BODIES: ColumnSet = ColumnSet { rotor: true, ..ColumnSet::INERTIAL };

/// Figure 2 of Nguyen-Tuong & Peters 2010: an arm that rigid bodies describe, an arm that they do not describe, and
/// the models learned of each.
///
/// ```text
/// learn.train, learn.regression --diagnose, learn--> models
/// test, and of the real data outside --> their errors
/// ```
#[derive(Debug, Clone)]
pub struct LearningFigure {
    spec: LearningFigureSpec,
    plants: [PaperPlant; 2],
    resolved: String,
}

/// The two data sets of figure 2.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PaperData {
    /// The data that rigid bodies describe.
    Simulated,
    /// The data that rigid bodies do not describe.
    Real,
}

/// The arm that a data set comes from.
#[derive(Debug, Clone)]
pub struct PaperPlant {
    data: PaperData,
    plant: Scenario,
    file: PathBuf,
    loaded: Loaded,
}

impl PaperData {
    /// Name in files and keys.
    pub fn name(self) -> &'static str {
        match self {
            Self::Simulated => "simulated",
            Self::Real => "real",
        }
    }

    /// Path of the scenario of its arm, relative to the scenario that names it.
    fn scenario(self) -> PathBuf {
        Path::new("logs").join(self.name()).join("scenario.toml")
    }
}

impl PaperPlant {
    /// The data set of the arm.
    pub fn data(&self) -> PaperData {
        self.data
    }

    /// The scenario of the arm, with only the runs that the figure needs.
    pub fn plant(&self) -> &Scenario {
        &self.plant
    }

    /// The file of the arm's scenario.
    pub fn file(&self) -> &Path {
        &self.file
    }

    /// The robot as described.
    pub fn loaded_robot(&self) -> &Loaded {
        &self.loaded
    }
}

impl LearningFigure {
    /// Name of the run outside the training data.
    pub const OUTSIDE: &str = "outside";

    /// Reads the figure from its scenario; `seed` replaces the seeds of the arms.
    ///
    /// # Errors
    ///
    /// [`ExperimentError::Document`](experiment::ExperimentError::Document), at the value at fault, and the errors of
    /// the scenario of an arm.
    pub fn from_document(document: &Document, seed: Option<u64>) -> Result<Self, BenchmarkError> {
        let FigureScenario { figure: FigureSpec::Learning(spec) } = document.parse()? else {
            let message = "another figure, figure.learning was expected";
            return Err(document.mistake(&KeyPath::root().key("figure"), message, None).into());
        };
        let check = Checker { document, spec: &spec, seed };
        check.counts()?;
        let simulated = check.plant(PaperData::Simulated, &spec.simulated)?;
        let real = check.plant(PaperData::Real, &spec.real)?;
        check.same_joints(&simulated, &real)?;
        let resolved = resolve(document, &spec);
        Ok(Self { spec: *spec, plants: [simulated, real], resolved })
    }

    /// The scenario as one text that extends nothing; its arms are those of
    /// [`plants`](Self::plants), in `logs/NAME/scenario.toml` beside it.
    pub fn self_contained_text(&self) -> &str {
        &self.resolved
    }

    /// The figure as it was written.
    pub fn spec(&self) -> &LearningFigureSpec {
        &self.spec
    }

    /// The arms.
    pub fn plants(&self) -> &[PaperPlant; 2] {
        &self.plants
    }

    /// The robot as described.
    pub fn robot(&self) -> &Robot {
        &self.plants[1].loaded.robot
    }

    /// The runs in which causes are found and from which models are learned.
    pub fn learning_runs(&self) -> Vec<&str> {
        let mut names: Vec<&str> = Vec::new();
        for name in self.spec.learn.train.iter().chain(&self.spec.learn.regression) {
            if !names.contains(&name.as_str()) {
                names.push(name);
            }
        }
        names
    }

    /// The runs for the errors, without the run outside.
    pub fn test(&self) -> Vec<&str> {
        self.spec.test.iter().map(String::as_str).collect()
    }

    /// Share of the motion outside in which a joint is beyond its positions in the training, by joint.
    pub fn outside_share(&self) -> Vec<f64> {
        let runs = self.plants[1].plant.runs();
        let joints = self.robot().joint_count();
        let mut ranges = vec![[f64::INFINITY, f64::NEG_INFINITY]; joints];
        for run in runs.iter().filter(|run| self.spec.learn.train.contains(&run.name)) {
            for q in positions(&run.motion) {
                for (range, q) in ranges.iter_mut().zip(q) {
                    *range = [range[0].min(q), range[1].max(q)];
                }
            }
        }
        let outside = runs.iter().filter(|run| run.name == Self::OUTSIDE);
        let outside: Vec<Vec<f64>> = outside.flat_map(|run| positions(&run.motion)).collect();
        let share = |j: usize| {
            let is_beyond = |q: &&Vec<f64>| q[j] < ranges[j][0] || q[j] > ranges[j][1];
            outside.iter().filter(is_beyond).count() as f64 / outside.len() as f64
        };
        (0..joints).map(share).collect()
    }

    /// Learns [`PAPER_MODELS`] from the logs of an arm, in which a diagnosis has found `named`.
    ///
    /// # Errors
    ///
    /// The errors of the learner.
    pub fn learn(
        &self,
        plant: &PaperPlant,
        logs: &[Run],
        named: &Robot,
        progress: &dyn Progress,
    ) -> Result<Learned, BenchmarkError> {
        Ok(Learned::of(&self.lesson(plant), logs, Some(named), progress)?)
    }

    /// Reads the models of an arm from the folder in which they were saved.
    ///
    /// # Errors
    ///
    /// The errors of [`Learned::load`].
    pub fn load(&self, plant: &PaperPlant, folder: &Path) -> Result<Learned, BenchmarkError> {
        Ok(Learned::load_kinds(&PAPER_MODELS, &plant.loaded.robot, folder)?)
    }

    /// The errors of models on held-out logs, after the low-pass of their training data.
    ///
    /// # Errors
    ///
    /// [`ExperimentError::Log`](experiment::ExperimentError::Log) for logs that cannot be prepared.
    pub fn errors(
        &self,
        plant: &PaperPlant,
        models: &Learned,
        [learned, test]: [&[Run]; 2],
    ) -> Result<Vec<ModelErrors>, BenchmarkError> {
        let lesson = self.lesson(plant);
        let cutoff_hz = lesson.prepare(learned, None)?.cutoff_hz;
        let prepared = lesson.prepare(test, Some(cutoff_hz))?;
        Ok(ModelErrors::of(models, &prepared, self.spec.test_points))
    }

    fn lesson<'a>(&'a self, plant: &'a PaperPlant) -> Lesson<'a> {
        Lesson {
            loaded: &plant.loaded,
            plant_file: &plant.file,
            learn: &self.spec.learn,
            kinds: &PAPER_MODELS,
            columns: RIGID_BODIES,
        }
    }
}

/// The positions of a motion, at 100 Hz.
fn positions(motion: &Motion) -> impl Iterator<Item = Vec<f64>> {
    let last = (100.0 * motion.duration_s()) as usize;
    (0..=last).map(|k| motion.at(0.01 * k as f64).q)
}

/// The path of a key of the figure.
fn key(name: &str) -> KeyPath {
    KeyPath::root().key("figure").key("learning").key(name)
}

/// The scenario with its arms in files beside it.
fn resolve(document: &Document, spec: &LearningFigureSpec) -> String {
    let beside = |data: PaperData| DataSpec { plant: data.scenario(), settings: Vec::new() };
    let mut spec = LearningFigureSpec {
        simulated: beside(PaperData::Simulated),
        real: beside(PaperData::Real),
        ..spec.clone()
    };
    spec.outside.anchor(document.directory_of(&key("outside")));
    let scenario = FigureScenario { figure: FigureSpec::Learning(Box::new(spec)) };
    toml::to_string(&scenario).unwrap_or_else(|_| document.to_toml())
}

struct Checker<'a> {
    document: &'a Document,
    spec: &'a LearningFigureSpec,
    seed: Option<u64>,
}

impl Checker<'_> {
    fn counts(&self) -> Result<(), DocumentError> {
        let learn = &self.spec.learn;
        let train = key("learn").key("train");
        let one_run = "no run, one at least was expected";
        let one_point = "0, at least one was expected";
        for (is_wrong, path, message) in [
            (learn.train.is_empty(), train, one_run),
            (self.spec.test.is_empty(), key("test"), one_run),
            (learn.points == 0, key("learn").key("points"), one_point),
            (self.spec.test_points == 0, key("test_points"), one_point),
        ] {
            if is_wrong {
                return Err(self.document.mistake(&path, message, None));
            }
        }
        let is_learned =
            |name: &String| learn.train.iter().chain(&learn.regression).any(|n| n == name);
        match self.spec.test.iter().position(is_learned) {
            None => Ok(()),
            Some(i) => {
                let message = format!(
                    "{}, a run was expected that nothing is learned from: what is learned is \
                     tested on it",
                    self.spec.test[i]
                );
                Err(self.document.mistake(&key("test").index(i), message, None))
            }
        }
    }

    /// The arm of a data set, with the runs that the figure needs.
    fn plant(&self, data: PaperData, spec: &DataSpec) -> Result<PaperPlant, BenchmarkError> {
        let path = key(data.name());
        let (mut said, file) = document_at(self.document, &path.key("plant"), &spec.plant)?;
        for setting in &spec.settings {
            said.set(setting)?;
        }
        let whole = Scenario::from_document(&with_seed(said, self.seed)?)?;
        let lists = [
            (key("learn").key("train"), &self.spec.learn.train),
            (key("learn").key("regression"), &self.spec.learn.regression),
            (key("test"), &self.spec.test),
        ];
        for (path, names) in &lists {
            known_runs(self.document, path, names, &whole)?;
        }
        let loaded = Robot::load(whole.robot_file())?;
        // The motions of this text can be read from any folder.
        let scenario = data.scenario().display().to_string();
        let mut arm: ScenarioSpec =
            Document::from_text(&scenario, whole.self_contained_text())?.parse()?;
        arm.run.retain(|run| lists.iter().any(|(_, names)| names.contains(&run.name)));
        if data == PaperData::Real {
            arm.run.push(self.outside(&loaded.robot, &arm.run)?);
        }
        let text = toml::to_string(&arm).unwrap_or_default();
        let plant = Scenario::from_document(&Document::from_text(&scenario, &text)?)?;
        Ok(PaperPlant { data, plant, file, loaded })
    }

    /// The run outside the training data, with the lead-in of the last other run.
    fn outside(&self, robot: &Robot, others: &[RunSpec]) -> Result<RunSpec, BenchmarkError> {
        let path = key("outside");
        motion_at(self.document, &path, &self.spec.outside, robot)?;
        let mut motion = self.spec.outside.clone();
        motion.anchor(self.document.directory_of(&path));
        let lead_in_s = others.last().map_or(1.0, |run| run.lead_in_s);
        Ok(RunSpec {
            name: LearningFigure::OUTSIDE.to_owned(),
            motion,
            lead_in_s,
            effect: Vec::new(),
        })
    }

    fn same_joints(&self, simulated: &PaperPlant, real: &PaperPlant) -> Result<(), DocumentError> {
        let [one, other] = [simulated, real].map(|plant| &plant.loaded.robot);
        if one.joint_names().eq(other.joint_names()) {
            return Ok(());
        }
        let message = format!(
            "{} has other joints than {} of the real data, the same were expected",
            one.name(),
            other.name()
        );
        Err(self.document.mistake(&key("simulated").key("plant"), message, None))
    }
}
