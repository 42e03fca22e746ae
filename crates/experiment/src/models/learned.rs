use std::collections::BTreeMap;
use std::path::Path;

use diagnosis::Settings;
use dynamics::ColumnSet;
use learner::{
    Mean, Model, ModelKind, Regression, RigidBodyFit, RobotTorque, Samples, TrainSettings, Training,
};
use logs::{PrepareSettings, Prepared, PreparedRun, Run, centre_commands, prepare, rest_speeds};
use robot::{Loaded, Robot};

use crate::error::ExperimentError;
use crate::progress::Progress;
use crate::scenario::tracking_scenario::TrackingScenario;
use crate::scenario::tracking_spec::LearnSpec;

/// The models that a scenario feeds forward, ready to predict.
#[derive(Debug, Clone)]
pub struct Learned {
    models: BTreeMap<&'static str, Model>,
}

impl Learned {
    /// The model of a kind.
    pub fn model(&self, kind: ModelKind) -> Option<&Model> {
        self.models.get(kind.name())
    }

    /// The robot extended by named effects, with the speeds below which its joints rest.
    pub fn named_torque(&self) -> Option<&RobotTorque> {
        match &self.model(ModelKind::Named)?.mean {
            Mean::Robot(torque) => Some(torque),
            _ => None,
        }
    }

    /// Writes every model into an existing folder, as `<kind>.parquet`.
    ///
    /// # Errors
    ///
    /// [`ExperimentError::Learner`].
    pub fn save(&self, folder: &Path) -> Result<(), ExperimentError> {
        for (name, model) in &self.models {
            model.save(&folder.join(format!("{name}.parquet")))?;
        }
        Ok(())
    }

    /// Reads the models that a scenario feeds forward from a folder that
    /// [`save`](Self::save) or `plumbline learn` has written.
    ///
    /// # Errors
    ///
    /// [`ExperimentError::NoModel`] and [`ExperimentError::Learner`].
    pub fn load(scenario: &TrackingScenario, folder: &Path) -> Result<Self, ExperimentError> {
        Self::load_kinds(&kinds(scenario), scenario.robot(), folder)
    }

    /// Reads models of these kinds from such a folder.
    ///
    /// # Errors
    ///
    /// As [`load`](Self::load).
    pub fn load_kinds(
        kinds: &[ModelKind],
        robot: &Robot,
        folder: &Path,
    ) -> Result<Self, ExperimentError> {
        let mut models = BTreeMap::new();
        for &kind in kinds {
            let path = folder.join(format!("{kind}.parquet"));
            if !path.exists() {
                return Err(ExperimentError::NoModel { path, model: kind });
            }
            models.insert(kind.name(), Model::load(&path, robot)?);
        }
        Ok(Self { models })
    }

    /// Learns the models that a scenario feeds forward from the logs of its arm.
    ///
    /// `named` is the robot extended by the arm's effects. Without it, a diagnosis finds the effects in the logs
    /// alone.
    ///
    /// # Errors
    ///
    /// [`ExperimentError::NothingToLearnFrom`], and the errors of diagnosis and learner.
    pub fn learn(
        scenario: &TrackingScenario,
        logs: &[Run],
        named: Option<&Robot>,
        progress: &dyn Progress,
    ) -> Result<Self, ExperimentError> {
        let lesson = Lesson {
            loaded: scenario.loaded_robot(),
            plant_file: scenario.plant_file(),
            learn: scenario.learn(),
            kinds: &kinds(scenario),
            columns: ColumnSet::INERTIAL,
        };
        Self::of(&lesson, logs, named, progress)
    }

    /// Learns from the logs of an arm as a lesson says, with `named` as in [`learn`](Self::learn).
    ///
    /// # Errors
    ///
    /// The errors of the learner.
    pub fn of(
        lesson: &Lesson,
        logs: &[Run],
        named: Option<&Robot>,
        progress: &dyn Progress,
    ) -> Result<Self, ExperimentError> {
        let mut models = BTreeMap::new();
        let (kinds, robot) = (lesson.kinds, lesson.robot());
        if kinds.iter().all(|kind| *kind == ModelKind::Cad) {
            let joints = robot.joint_count();
            // Without friction no direction is asked for, so the speed of rest is of no account.
            let torque = RobotTorque::new(robot.clone(), vec![1e-3; joints]);
            let mean = Mean::Robot(Box::new(torque));
            let cad = Model::new(ModelKind::Cad, robot, mean, vec![0.0; joints]);
            models.insert(ModelKind::Cad.name(), cad);
            return Ok(Self { models });
        }
        let data = Data::new(lesson, logs)?;
        let named = match named {
            None if kinds.iter().any(|kind| kind.needs_named_effects()) => {
                Some(extend_by_diagnosis(lesson, logs, progress)?)
            }
            given => given.cloned(),
        };
        let needs_no_fit = |kind: &ModelKind| matches!(kind, ModelKind::Cad | ModelKind::Named);
        let fit = match kinds.iter().all(needs_no_fit) {
            true => None,
            false => Some(rigid_bodies(lesson, &data.regression, progress)?),
        };
        let settings = TrainSettings { points: lesson.learn.points, ..TrainSettings::default() };
        let speeds = data.rest_speeds.clone();
        let mut training = Training::new(robot, &data.train, speeds, &settings, progress)?;
        if let Some(fit) = &fit {
            training = training.with_regression(fit);
        }
        if let Some(named) = &named {
            training = training.with_named(named);
        }
        for &kind in kinds {
            progress.begin(kind.name());
            models.insert(kind.name(), training.fit(kind)?.model);
        }
        Ok(Self { models })
    }
}

/// The models to learn, and the data to learn them from.
pub struct Lesson<'a> {
    /// The robot as described.
    pub loaded: &'a Loaded,
    /// The scenario of the arm, which has the runs.
    pub plant_file: &'a Path,
    /// The runs, and the number of samples to use.
    pub learn: &'a LearnSpec,
    /// The models.
    pub kinds: &'a [ModelKind],
    /// The parameters of the rigid bodies.
    pub columns: ColumnSet,
}

impl Lesson<'_> {
    fn robot(&self) -> &Robot {
        &self.loaded.robot
    }

    /// The logs after the low-pass at `cutoff_hz`, or at the cut-off that their data suggest.
    ///
    /// # Errors
    ///
    /// [`ExperimentError::Log`].
    pub fn prepare(
        &self,
        logs: &[Run],
        cutoff_hz: Option<f64>,
    ) -> Result<Prepared, ExperimentError> {
        let mut prepared = prepare(logs, &PrepareSettings { cutoff_hz })?;
        centre_commands(self.robot(), &mut prepared.runs, self.loaded.control.rate_hz);
        Ok(prepared)
    }
}

/// The models behind what a scenario feeds forward.
fn kinds(scenario: &TrackingScenario) -> Vec<ModelKind> {
    let mut kinds: Vec<ModelKind> = Vec::new();
    for kind in scenario.all_feedforward().into_iter().filter_map(|kind| kind.model()) {
        if !kinds.contains(&kind) {
            kinds.push(kind);
        }
    }
    kinds
}

/// The parameters of the rigid bodies that fit the samples best.
fn rigid_bodies(
    lesson: &Lesson,
    samples: &Samples,
    progress: &dyn Progress,
) -> Result<RigidBodyFit, ExperimentError> {
    progress.begin("regression of the rigid bodies");
    let mut regression = Regression::new(lesson.robot(), lesson.columns);
    regression.add_samples(samples)?;
    Ok(regression.fit(None)?)
}

/// The robot extended by the effects that a diagnosis finds in the logs.
fn extend_by_diagnosis(
    lesson: &Lesson,
    logs: &[Run],
    progress: &dyn Progress,
) -> Result<Robot, ExperimentError> {
    progress.begin("diagnosis");
    let settings =
        Settings { control_rate_hz: lesson.loaded.control.rate_hz, ..Settings::default() };
    Ok(diagnosis::diagnose(lesson.robot(), logs, &settings, &diagnosis::Silent)?.extended)
}

/// The samples of the logs, all filtered alike.
struct Data {
    train: Samples,
    regression: Samples,
    rest_speeds: Vec<f64>,
}

impl Data {
    fn new(lesson: &Lesson, logs: &[Run]) -> Result<Self, ExperimentError> {
        let learn = lesson.learn;
        if let ([], Some(&model)) = (learn.train.as_slice(), lesson.kinds.first()) {
            let path = lesson.plant_file.to_owned();
            return Err(ExperimentError::NothingToLearnFrom { path, model });
        }
        let prepared = lesson.prepare(logs, None)?;
        let train = select_runs(&prepared, &learn.train);
        let regression = match learn.regression.as_slice() {
            [] => Samples::new(&train),
            names => Samples::new(&select_runs(&prepared, names)),
        };
        Ok(Self { rest_speeds: rest_speeds(&train), train: Samples::new(&train), regression })
    }
}

/// The prepared runs that are logs with these names, or parts of such logs.
pub(crate) fn select_runs(prepared: &Prepared, names: &[String]) -> Prepared {
    let is_meant = |run: &&PreparedRun| names.iter().any(|name| is_part_of(&run.name, name));
    prepared.with_runs(prepared.runs.iter().filter(is_meant).cloned().collect())
}

/// Whether a prepared run is a log, or a part of a log that was split at gaps.
fn is_part_of(prepared: &str, log: &str) -> bool {
    prepared.strip_prefix(log).is_some_and(|rest| rest.is_empty() || rest.starts_with(" part "))
}
