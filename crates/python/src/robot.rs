use std::path::{Path, PathBuf};
use std::sync::Arc;

use ::robot::{Loaded, RobotError};
use cli::{PartArguments, RobotInit};
use dynamics::Dynamics;
use exchange::Format;
use numpy::PyArrayDyn;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::arrays::table;
use crate::error::exception;
use crate::program::json_of;

/// A robot as its files describe it.
#[pyclass(frozen, name = "Robot", module = "plumbline")]
pub struct PyRobot {
    /// What was read, once for all that use it.
    pub loaded: Arc<Loaded>,
    /// The file that was named: a description, or a `robot.toml` that names one.
    pub path: PathBuf,
    /// The joints that were asked for.
    pub asked: Option<Vec<String>>,
    /// Where joints were asked to be locked (rad or m).
    pub locked: Vec<(String, f64)>,
    dynamics: Dynamics,
}

impl PyRobot {
    /// The robot of files that were read, with another one in the place of what they describe.
    pub fn with_robot(&self, robot: ::robot::Robot) -> Self {
        let loaded = Loaded { robot, ..(*self.loaded).clone() };
        let (asked, locked) = (self.asked.clone(), self.locked.clone());
        Self { locked, ..Self::new(loaded, self.path.clone(), asked) }
    }

    fn new(loaded: Loaded, path: PathBuf, asked: Option<Vec<String>>) -> Self {
        let dynamics = Dynamics::new(&loaded.robot);
        Self { loaded: Arc::new(loaded), path, asked, locked: Vec::new(), dynamics }
    }

    /// The robot of a file, all of its joints.
    pub fn read(path: &Path) -> PyResult<Self> {
        Self::load(path.to_owned(), None, Vec::new(), Vec::new(), false)
    }

    /// Its rigid bodies.
    pub fn dynamics(&self) -> &Dynamics {
        &self.dynamics
    }
}

/// The joints and meshes that the arguments of Python name.
fn part(
    joints: Option<&[String]>,
    locked: Vec<(String, f64)>,
    package: Vec<(String, PathBuf)>,
    allow_outside: bool,
) -> PyResult<PartArguments> {
    if joints.is_some_and(<[String]>::is_empty) {
        return Err(PyValueError::new_err("joints: at least one name was expected"));
    }
    let joints = joints.map(<[String]>::to_vec).unwrap_or_default();
    Ok(PartArguments { joints, locked, package, allow_outside })
}

#[pymethods]
impl PyRobot {
    #[new]
    #[pyo3(signature = (path, joints=None, *, locked=Vec::new(), packages=Vec::new(), allow_outside=false))]
    fn load(
        path: PathBuf,
        joints: Option<Vec<String>>,
        locked: Vec<(String, f64)>,
        packages: Vec<(String, PathBuf)>,
        allow_outside: bool,
    ) -> PyResult<Self> {
        let part = part(joints.as_deref(), locked.clone(), packages, allow_outside)?;
        Ok(Self { locked, ..Self::new(part.load(&path).map_err(exception)?, path, joints) })
    }

    /// Writes a first robot.toml and scenario.toml, as `plumbline robot init` does, and gives its warnings.
    #[staticmethod]
    #[pyo3(name = "init", signature = (path, folder, joints=None, *, locked=Vec::new(), packages=Vec::new(), allow_outside=false, force=false))]
    fn write_first_files(
        path: PathBuf,
        folder: PathBuf,
        joints: Option<Vec<String>>,
        locked: Vec<(String, f64)>,
        packages: Vec<(String, PathBuf)>,
        allow_outside: bool,
        force: bool,
    ) -> PyResult<Vec<String>> {
        let part = part(joints.as_deref(), locked, packages, allow_outside)?;
        let written =
            cli::init_robot(&RobotInit { file: path, part, out: folder, force, json: false });
        Ok(written.map_err(exception)?.warnings)
    }

    /// Name of the robot.
    #[getter]
    fn name(&self) -> &str {
        self.loaded.robot.name()
    }

    /// The file that was named.
    #[getter]
    fn path(&self) -> &Path {
        &self.path
    }

    /// Names of the joints that move, in the order of every array.
    #[getter]
    pub fn joints(&self) -> Vec<String> {
        self.loaded.robot.joint_names().map(str::to_owned).collect()
    }

    /// Names of the links that they move.
    #[getter]
    fn links(&self) -> Vec<String> {
        self.loaded.robot.links().iter().map(|link| link.name.clone()).collect()
    }

    /// Joints that are locked, and where (rad or m).
    #[getter(locked)]
    fn locked_joints(&self) -> Vec<(String, f64)> {
        self.loaded.locked.iter().map(|lock| (lock.joint.clone(), lock.position)).collect()
    }

    /// What the owner of the files should know.
    #[getter]
    fn warnings(&self) -> Vec<String> {
        self.loaded.warnings.iter().map(ToString::to_string).collect()
    }

    /// Limits of the joints, one row each: lowest and highest position (rad or m), speed (rad/s or m/s)
    /// and torque (N m or N); NaN where the files say none.
    #[getter]
    fn limits<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        let of = |link: &::robot::Link| {
            let limits = &link.joint.limits;
            let (low, high) = limits.position.unwrap_or((f64::NAN, f64::NAN));
            [low, high, limits.velocity.unwrap_or(f64::NAN), limits.effort.unwrap_or(f64::NAN)]
        };
        table(py, self.loaded.robot.links().iter().flat_map(of).collect(), 4, false)
    }

    /// The robot in a format, and as JSON what became of every quantity.
    fn export(&self, format: &str) -> PyResult<(String, String)> {
        let formats = || Format::ALL.into_iter().chain(Format::ACTUATORS);
        let Some(known) = formats().find(|known| known.name() == format) else {
            let all = formats().map(Format::name).collect::<Vec<_>>().join(", ");
            return Err(PyValueError::new_err(format!(
                "format: found {format:?}, one of {all} was expected"
            )));
        };
        let export = exchange::export(&self.loaded, &self.source()?, known).map_err(exception)?;
        Ok((export.text, json_of(&export.fates)?))
    }

    fn __repr__(&self) -> String {
        format!("Robot({:?}, joints=[{}])", self.name(), self.joints().join(", "))
    }
}

impl PyRobot {
    /// The text of the description.
    fn source(&self) -> PyResult<String> {
        if let Some(text) = &self.loaded.expanded {
            return Ok(text.clone());
        }
        let path = &self.loaded.urdf_path;
        files::text(path, files::KEPT_BYTES).map_err(|error| {
            let reason = error.to_string();
            exception(RobotError::Unreadable { path: path.clone(), reason })
        })
    }
}
