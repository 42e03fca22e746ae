use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;

use cli::{ColumnArguments, ExcerptArguments};
use logs::{Channel, ColumnMap, FormatError, LogError, ReadOptions, Run};
use numpy::PyArrayDyn;
use pyo3::exceptions::{PyKeyError, PyTypeError, PyValueError};
use pyo3::prelude::*;

use crate::arrays::{SampleRows, TableColumns, rows_of, table, type_name, vector};
use crate::error::exception;

/// One recorded run.
#[pyclass(frozen, name = "Log", module = "plumbline")]
pub struct PyLog {
    name: String,
    source: Source,
}

enum Source {
    /// Signals by channel, of joints that are named or those of the robot in its order.
    Arrays { time: Vec<f64>, joints: Option<Vec<String>>, signals: Signals },
    /// Columns as a file names them, or as the map of a file does.
    Columns(BTreeMap<String, Vec<f64>>, Option<Box<ColumnMap>>),
    /// A file, which is read for a robot.
    File(ColumnArguments, PathBuf),
    /// A run that was read.
    Run(Box<Run>),
}

type Signals = BTreeMap<Channel, Vec<Vec<f64>>>;

impl PyLog {
    /// A run that is there.
    pub fn of_run(run: Run) -> Self {
        Self { name: run.name.clone(), source: Source::Run(Box::new(run)) }
    }

    /// The run that it is of a robot.
    ///
    /// # Errors
    ///
    /// [`crate::error::PlumblineError`] for a log that cannot be used, `ValueError` for joints that are
    /// not those of the robot.
    pub fn run(&self, robot: &robot::Robot) -> PyResult<Run> {
        let joints: Vec<&str> = robot.joint_names().collect();
        match &self.source {
            Source::File(columns, path) => {
                let asked = columns.episodes_of(path).map_err(exception)?;
                let [episode] = asked.iter().collect::<Vec<_>>()[..] else {
                    let found = asked.iter().filter_map(|episode| episode.number).collect();
                    let path = path.clone();
                    return Err(exception(LogError::from(FormatError::Episode {
                        path,
                        asked: None,
                        found,
                    })));
                };
                let reader = columns.reader().map_err(exception)?;
                reader.read(path, episode, robot).map_err(exception)
            }
            Source::Run(run) => {
                if run.joints.iter().map(|c| c.name.as_str()).eq(joints.iter().copied()) {
                    return Ok((**run).clone());
                }
                let own: Vec<&str> = run.joints.iter().map(|c| c.name.as_str()).collect();
                Err(self.other_joints(&own, &joints))
            }
            Source::Columns(columns, map) => self.read(columns.clone(), map.as_deref(), robot),
            Source::Arrays { time, joints: named, signals } => {
                let own = named.as_ref().map_or_else(|| joints.clone(), |all| as_strs(all));
                if joints.iter().any(|joint| !own.contains(joint)) {
                    return Err(self.other_joints(&own, &joints));
                }
                let mut columns = BTreeMap::from([("time".to_owned(), time.clone())]);
                for (channel, all) in signals {
                    if all.len() != own.len() {
                        let (argument, found, n) = (argument(*channel), all.len(), own.len());
                        return Err(PyValueError::new_err(format!(
                            "{argument}: {found} columns, {n} were expected, one a joint of {}: {}",
                            robot.name(),
                            own.join(", ")
                        )));
                    }
                    let named = own.iter().map(|joint| format!("{joint}.{}", channel.suffix()));
                    columns.extend(named.zip(all.iter().cloned()));
                }
                self.read(columns, None, robot)
            }
        }
    }

    fn read(
        &self,
        columns: BTreeMap<String, Vec<f64>>,
        map: Option<&ColumnMap>,
        robot: &robot::Robot,
    ) -> PyResult<Run> {
        let options = ReadOptions { map, ..ReadOptions::default() };
        logs::run_of_columns(&self.name, columns, robot, &options).map_err(exception)
    }

    fn other_joints(&self, own: &[&str], expected: &[&str]) -> PyErr {
        PyValueError::new_err(format!(
            "joints: log {} has {}, those of the robot were expected: {}",
            self.name,
            own.join(", "),
            expected.join(", ")
        ))
    }

    /// The file, and the options of the program that read it; none of a log in memory.
    pub fn options(&self) -> Option<(&PathBuf, Vec<String>)> {
        let Source::File(columns, path) = &self.source else { return None };
        let mut options = Vec::new();
        if let Some(map) = &columns.map {
            options.extend(["--map".to_owned(), map.display().to_string()]);
        }
        if let Some(effort) = columns.effort.as_ref().filter(|effort| *effort != DEFAULT_EFFORT) {
            options.extend(["--effort".to_owned(), effort.clone()]);
        }
        if let Some(topic) = &columns.topic {
            options.extend(["--topic".to_owned(), topic.clone()]);
        }
        if columns.until_damage {
            options.push("--until-damage".to_owned());
        }
        let ExcerptArguments { from_s, to_s } = columns.excerpt;
        for (option, seconds) in [("--from-s", from_s), ("--to-s", to_s)] {
            options
                .extend(seconds.map(|s| [option.to_owned(), s.to_string()]).into_iter().flatten());
        }
        Some((path, options))
    }

    /// How the file that it is in is read.
    pub fn columns(&self) -> Option<&ColumnArguments> {
        match &self.source {
            Source::File(columns, _) => Some(columns),
            _ => None,
        }
    }

    /// The samples of a channel, joint by joint.
    fn channel(&self, channel: Channel) -> PyResult<Option<Vec<&[f64]>>> {
        Ok(match &self.source {
            Source::Arrays { signals, .. } => {
                signals.get(&channel).map(|all| all.iter().map(Vec::as_slice).collect())
            }
            Source::Columns(_, Some(_)) => return Err(self.unread()),
            Source::Columns(columns, None) => {
                let of = |joint: String| columns.get(&format!("{joint}.{}", channel.suffix()));
                joints_of(columns).into_iter().map(|joint| of(joint).map(Vec::as_slice)).collect()
            }
            Source::Run(run) => run.joints.iter().map(|c| c.get(channel)).collect(),
            Source::File(..) => return Err(self.unread()),
        })
    }

    fn unread(&self) -> PyErr {
        PyValueError::new_err(format!(
            "log {}: a file or a map is read for a robot: log.on(robot) has the samples",
            self.name
        ))
    }
}

/// The column of the effort where none is named.
const DEFAULT_EFFORT: &str = "effort";

/// The name of a channel's argument.
fn argument(channel: Channel) -> &'static str {
    match channel {
        Channel::Position => "q",
        Channel::Velocity => "qd",
        Channel::Acceleration => "qdd",
        Channel::Effort => "tau",
        Channel::DesiredPosition => "q_desired",
        Channel::DesiredVelocity => "qd_desired",
        Channel::DesiredAcceleration => "qdd_desired",
        Channel::CommandedEffort => "tau_commanded",
        Channel::LinkPosition => "q_link",
    }
}

fn as_strs(all: &[String]) -> Vec<&str> {
    all.iter().map(String::as_str).collect()
}

/// Joints that columns are named after.
fn joints_of(columns: &BTreeMap<String, Vec<f64>>) -> Vec<String> {
    let joint = |name: &String| name.strip_suffix(".position").map(str::to_owned);
    columns.keys().filter_map(joint).collect()
}

#[pymethods]
impl PyLog {
    #[new]
    #[pyo3(signature = (
        time, q, tau, qd=None, qdd=None, *, joints=None, q_desired=None, qd_desired=None,
        qdd_desired=None, tau_commanded=None, q_link=None, name="log"
    ))]
    #[expect(clippy::too_many_arguments, reason = "they are those of Python, by name")]
    fn new(
        time: &Bound<'_, PyAny>,
        q: &Bound<'_, PyAny>,
        tau: &Bound<'_, PyAny>,
        qd: Option<&Bound<'_, PyAny>>,
        qdd: Option<&Bound<'_, PyAny>>,
        joints: Option<Vec<String>>,
        q_desired: Option<&Bound<'_, PyAny>>,
        qd_desired: Option<&Bound<'_, PyAny>>,
        qdd_desired: Option<&Bound<'_, PyAny>>,
        tau_commanded: Option<&Bound<'_, PyAny>>,
        q_link: Option<&Bound<'_, PyAny>>,
        name: &str,
    ) -> PyResult<Self> {
        let distinct: Option<BTreeSet<_>> = joints.as_ref().map(|all| all.iter().collect());
        if distinct.map(|d| d.len()) != joints.as_ref().map(Vec::len) {
            return Err(PyValueError::new_err("joints: a name comes twice"));
        }
        let time = vector("time", time)?;
        if let Some(index) = time.iter().position(|t| !t.is_finite()) {
            return Err(PyValueError::new_err(format!(
                "time: row {index}: found {}, a finite number was expected",
                time[index]
            )));
        }
        let given = [
            (Channel::Position, Some(q)),
            (Channel::Velocity, qd),
            (Channel::Acceleration, qdd),
            (Channel::Effort, Some(tau)),
            (Channel::DesiredPosition, q_desired),
            (Channel::DesiredVelocity, qd_desired),
            (Channel::DesiredAcceleration, qdd_desired),
            (Channel::CommandedEffort, tau_commanded),
            (Channel::LinkPosition, q_link),
        ];
        let mut columns = joints.as_deref().map_or(TableColumns::Any, TableColumns::Joints);
        let mut signals = Signals::new();
        for (channel, value) in given {
            let Some(value) = value else { continue };
            let argument = argument(channel);
            let rows = SampleRows::new(argument, value, columns)?;
            if matches!(columns, TableColumns::Any) {
                columns = TableColumns::Count(rows.width());
            }
            if rows.len() != time.len() || rows.is_single {
                return Err(PyValueError::new_err(format!(
                    "{argument}: {} rows, {} were expected, one for each entry of time",
                    rows.len(),
                    time.len()
                )));
            }
            signals.insert(channel, rows.columns());
        }
        Ok(Self { name: name.to_owned(), source: Source::Arrays { time, joints, signals } })
    }

    /// A log in a file, which is read when it is used with a robot.
    #[staticmethod]
    #[pyo3(signature = (path, *, map=None, effort=DEFAULT_EFFORT, topic=None, episode=None,
        from_s=None, to_s=None, until_damage=false))]
    #[expect(clippy::too_many_arguments, reason = "they are those of Python, by name")]
    fn read_file(
        path: PathBuf,
        map: Option<PathBuf>,
        effort: &str,
        topic: Option<String>,
        episode: Option<u64>,
        from_s: Option<f64>,
        to_s: Option<f64>,
        until_damage: bool,
    ) -> PyResult<Self> {
        for (name, seconds) in [("from_s", from_s), ("to_s", to_s)] {
            if let Some(s) = seconds.filter(|s| !(s.is_finite() && *s >= 0.0)) {
                let message = format!("{name}: found {s}, 0 or a positive number was expected");
                return Err(PyValueError::new_err(message));
            }
        }
        if !path.exists() && ::logs::files_of_run(&path).is_none() {
            return Err(exception(LogError::from(FormatError::Missing { path })));
        }
        let name = ::logs::name_of_run(&path);
        let effort = (effort != DEFAULT_EFFORT).then(|| effort.to_owned());
        let excerpt = ExcerptArguments { from_s, to_s };
        let episodes = episode.map(|episode| episode..=episode).into_iter().collect();
        let columns = ColumnArguments { map, effort, topic, episodes, until_damage, excerpt };
        Ok(Self { name, source: Source::File(columns, path) })
    }

    /// Columns by name, as a file has them.
    #[staticmethod]
    #[pyo3(signature = (columns, *, map=None, name="log"))]
    fn of_columns(
        columns: Vec<(String, Bound<'_, PyAny>)>,
        map: Option<PathBuf>,
        name: &str,
    ) -> PyResult<Self> {
        let map = map.map(|path| ColumnMap::load(&path).map(Box::new)).transpose();
        let map = map.map_err(exception)?;
        let mut read = BTreeMap::new();
        for (column, values) in columns {
            if let Some(twice) = read.insert(column.clone(), vector(&column, &values)?) {
                let rows = twice.len();
                return Err(PyValueError::new_err(format!(
                    "frame: column {column} comes twice, of {rows} rows"
                )));
            }
        }
        if map.is_none() && !read.contains_key("time") {
            return Err(PyKeyError::new_err("frame: a column time (s) was expected"));
        }
        Ok(Self { name: name.to_owned(), source: Source::Columns(read, map) })
    }

    /// The log as it is read and checked for a robot.
    fn on(&self, robot: &Bound<'_, PyAny>) -> PyResult<Self> {
        let robot = robot.cast::<crate::robot::PyRobot>().map_err(|_| {
            PyTypeError::new_err(format!("robot: found {}, a Robot was expected", type_name(robot)))
        })?;
        Ok(Self::of_run(self.run(&robot.get().loaded.robot)?))
    }

    /// Name of the log.
    #[getter]
    fn name(&self) -> &str {
        &self.name
    }

    /// Names of the joints, where the log knows them.
    #[getter]
    fn joints(&self) -> Option<Vec<String>> {
        match &self.source {
            Source::Arrays { joints, .. } => joints.clone(),
            Source::Columns(columns, None) => Some(joints_of(columns)),
            Source::Run(run) => Some(run.joints.iter().map(|c| c.name.clone()).collect()),
            Source::Columns(..) | Source::File(..) => None,
        }
    }

    /// What was put right while it was read, in sentences.
    #[getter(mended)]
    fn repairs(&self) -> Vec<String> {
        match &self.source {
            Source::Run(run) => run.mended.iter().map(ToString::to_string).collect(),
            _ => Vec::new(),
        }
    }

    /// Time of each sample (s).
    #[getter]
    fn time<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        let time = match &self.source {
            Source::Arrays { time, .. } => time,
            Source::Columns(columns, None) => &columns["time"],
            Source::Run(run) => &run.time,
            Source::Columns(..) | Source::File(..) => return Err(self.unread()),
        };
        table(py, time.clone(), time.len(), true)
    }

    /// The samples of a signal, such as `q`, of the shape (samples, joints); none where the log lacks it.
    fn signal<'py>(
        &self,
        py: Python<'py>,
        name: &str,
    ) -> PyResult<Option<Bound<'py, PyArrayDyn<f64>>>> {
        let channel = Channel::ALL.into_iter().find(|channel| argument(*channel) == name);
        let Some(channel) = channel else {
            let all = Channel::ALL.map(argument).join(", ");
            return Err(PyValueError::new_err(format!(
                "name: found {name:?}, one of {all} was expected"
            )));
        };
        let columns = self.channel(channel)?;
        columns.map(|all| table(py, rows_of(&all), all.len(), false)).transpose()
    }

    fn __repr__(&self) -> String {
        match &self.source {
            Source::File(_, path) => format!("Log.read({:?})", path.display().to_string()),
            _ => format!("Log({:?})", self.name),
        }
    }
}
