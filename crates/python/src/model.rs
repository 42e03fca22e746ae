use std::path::PathBuf;

use dynamics::ColumnSet;
use learner::{
    LearnerError, ModelKind, Regression, RobotTorque, Samples, TorqueModel, TorqueScore,
    TrainSettings, Training,
};
use logs::{PrepareSettings, centre_commands, prepare, rest_speeds};
use numpy::PyArrayDyn;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::arguments::positive;
use crate::arrays::{SampleRows, TableColumns, same_rows, table};
use crate::error::exception;
use crate::log::PyLog;
use crate::robot::PyRobot;
use crate::work::run;

/// A model of the torque.
#[pyclass(frozen, name = "Model", module = "plumbline")]
pub struct PyModel {
    model: learner::Model,
    joints: Vec<String>,
}

impl PyModel {
    fn new(model: learner::Model) -> Self {
        let joints = model.robot().joint_names().map(str::to_owned).collect();
        Self { model, joints }
    }

    /// What the model tells in every state, without the lock of the interpreter.
    fn in_states<'py>(
        &self,
        py: Python<'py>,
        [q, qd, qdd]: [&Bound<'py, PyAny>; 3],
        tells: fn(&learner::Model, &Samples) -> Vec<f64>,
    ) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        let rows = |name, value| SampleRows::new(name, value, TableColumns::Joints(&self.joints));
        let (q, qd, qdd) = (rows("q", q)?, rows("qd", qd)?, rows("qdd", qdd)?);
        same_rows([("q", &q), ("qd", &qd), ("qdd", &qdd)])?;
        let is_single = q.is_single;
        let states = [q, qd, qdd].map(SampleRows::into_numbers);
        let told = py.detach(|| tells(&self.model, &Samples::of_states(self.joints.len(), states)));
        table(py, told, self.joints.len(), is_single)
    }
}

/// Learns a model of the torque from logs.
///
/// # Errors
///
/// [`crate::error::PlumblineError`] for logs or settings that cannot be used.
#[pyfunction]
#[pyo3(signature = (
    robot, logs, model="gp-rbd", *, points=None, named=None, cutoff_hz=None, progress=None
))]
#[expect(clippy::too_many_arguments, reason = "they are those of Python, by name")]
pub fn learn(
    py: Python<'_>,
    robot: &PyRobot,
    logs: Vec<PyRef<'_, PyLog>>,
    model: &str,
    points: Option<usize>,
    named: Option<&PyRobot>,
    cutoff_hz: Option<f64>,
    progress: Option<Py<PyAny>>,
) -> PyResult<PyModel> {
    let wrong = |reason: String| PyValueError::new_err(format!("model: {reason}"));
    let kind: ModelKind = model.parse().map_err(wrong)?;
    let about = &robot.loaded.robot;
    let runs: Vec<_> = logs.iter().map(|log| log.run(about)).collect::<PyResult<_>>()?;
    let cutoff_hz = positive("cutoff_hz", cutoff_hz)?;
    let defaults = TrainSettings::default();
    let settings = TrainSettings { points: points.unwrap_or(defaults.points), ..defaults };
    let rate_hz = robot.loaded.control.rate_hz;
    let named = named.map(|named| &named.loaded.robot);
    let learned = run(py, progress.as_ref(), |work| {
        let mut prepared = prepare(&runs, &PrepareSettings { cutoff_hz })?;
        centre_commands(about, &mut prepared.runs, rate_hz);
        let samples = Samples::new(&prepared);
        let mut regression = Regression::new(about, ColumnSet::INERTIAL);
        regression.add_samples(&samples)?;
        let fit = regression.fit(None)?;
        let rest = rest_speeds(&prepared);
        let training = Training::new(about, &samples, rest, &settings, work)?.with_regression(&fit);
        let mut training = match named {
            Some(named) => training.with_named(named),
            None => training,
        };
        Ok::<_, LearnerError>(training.fit(kind)?.model)
    })?;
    Ok(PyModel::new(learned.map_err(exception)?))
}

#[pymethods]
impl PyModel {
    /// The model of a robot that `save`, `learn` or `track` has written.
    #[staticmethod]
    fn load(py: Python<'_>, path: PathBuf, robot: &PyRobot) -> PyResult<Self> {
        let about = &robot.loaded.robot;
        let model = run(py, None, |_| learner::Model::load(&path, about)?.with_variance())?;
        Ok(Self::new(model.map_err(exception)?))
    }

    /// What the description of a robot expects, rotors, friction and all else that it says included.
    #[staticmethod]
    #[pyo3(name = "described")]
    fn from_description(robot: &PyRobot, rest_speed: f64) -> PyResult<Self> {
        positive("rest_speed", Some(rest_speed))?;
        let about = robot.loaded.robot.clone();
        let n = about.joint_count();
        let torque = RobotTorque::new(about.clone(), vec![rest_speed; n]);
        let mean = learner::Mean::Robot(Box::new(torque));
        let noise = vec![0.0; n];
        Ok(Self::new(learner::Model::new(ModelKind::Cad, &about, mean, noise)))
    }

    /// Writes the model as Parquet.
    fn save(&self, path: PathBuf) -> PyResult<()> {
        self.model.save(&path).map_err(exception)
    }

    /// Its kind, as `plumbline learn` names it.
    #[getter]
    fn kind(&self) -> &'static str {
        self.model.kind.name()
    }

    /// Names of the joints.
    #[getter]
    fn joints(&self) -> Vec<String> {
        self.joints.clone()
    }

    /// The torque in every state.
    fn predict<'py>(
        &self,
        py: Python<'py>,
        q: &Bound<'py, PyAny>,
        qd: &Bound<'py, PyAny>,
        qdd: &Bound<'py, PyAny>,
    ) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        self.in_states(py, [q, qd, qdd], learner::Model::torque)
    }

    /// The variance of a measured torque about the prediction, NaN where the model tells none.
    fn variance<'py>(
        &self,
        py: Python<'py>,
        q: &Bound<'py, PyAny>,
        qd: &Bound<'py, PyAny>,
        qdd: &Bound<'py, PyAny>,
    ) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        self.in_states(py, [q, qd, qdd], learner::Model::variance)
    }

    /// Root mean square error of every joint in logs that the model was not learned from.
    #[pyo3(signature = (logs, *, cutoff_hz=None))]
    fn error<'py>(
        &self,
        py: Python<'py>,
        logs: Vec<PyRef<'_, PyLog>>,
        cutoff_hz: Option<f64>,
    ) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        let about = self.model.robot();
        let runs: Vec<_> = logs.iter().map(|log| log.run(about)).collect::<PyResult<_>>()?;
        let cutoff_hz = positive("cutoff_hz", cutoff_hz)?;
        let score = run(py, None, |_| {
            let prepared = prepare(&runs, &PrepareSettings { cutoff_hz })?;
            Ok::<_, logs::LogError>(TorqueScore::of(&self.model, &Samples::new(&prepared)))
        })?;
        let score = score.map_err(exception)?;
        table(py, score.rmse, self.joints.len(), true)
    }

    fn __repr__(&self) -> String {
        format!("Model({:?}, joints=[{}])", self.kind(), self.joints.join(", "))
    }
}
