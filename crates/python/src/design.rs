use std::path::{Path, PathBuf};

use cli::{DiagnosisFile, MotionDesign, MotionRequest};
use next_motion::DesignSettings;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::arguments::positive;
use crate::diagnosis::PyDiagnosis;
use crate::error::exception;
use crate::log::PyLog;
use crate::robot::PyRobot;
use crate::work::run;

/// The motion that settles what a diagnosis left open.
#[pyclass(frozen, name = "Design", module = "plumbline")]
pub struct PyDesign {
    design: MotionDesign,
    robot_file: PathBuf,
}

/// Searches the motion that tells apart what a diagnosis could not, or two causes that are named.
///
/// # Errors
///
/// `ValueError` for neither, [`crate::error::PlumblineError`] where nothing is open or a cause has no place.
#[pyfunction]
#[pyo3(signature = (
    robot, diagnosis=None, *, separate=None, duration_s=None, seed=None, progress=None
))]
pub fn design(
    py: Python<'_>,
    robot: &PyRobot,
    diagnosis: Option<&PyDiagnosis>,
    separate: Option<[String; 2]>,
    duration_s: Option<f64>,
    seed: Option<u64>,
    progress: Option<Py<PyAny>>,
) -> PyResult<PyDesign> {
    if diagnosis.is_none() && separate.is_none() {
        let words = "diagnosis: found None, one was expected where separate names no two causes";
        return Err(PyValueError::new_err(words));
    }
    let defaults = DesignSettings::default();
    let settings = DesignSettings {
        duration_s: positive("duration_s", duration_s)?.unwrap_or(defaults.duration_s),
        seed: seed.unwrap_or(defaults.seed),
    };
    let read = |diagnosis: &PyDiagnosis| {
        let name = Path::new("diagnosis");
        DiagnosisFile::parse(&diagnosis.json()?, name, &robot.loaded.robot).map_err(exception)
    };
    let file = diagnosis.map(read).transpose()?;
    let request = MotionRequest {
        loaded: &robot.loaded,
        diagnosed: file.as_ref().zip(diagnosis.map(PyDiagnosis::runs)),
        separate: separate.as_ref().map(|pair| pair.each_ref().map(String::as_str)),
        settings,
    };
    let design = run(py, progress.as_ref(), |work| {
        work.stage("searching a motion", 0);
        MotionDesign::new(&request).map_err(Box::new)
    })?;
    let design = design.map_err(|error| exception(*error))?;
    Ok(PyDesign { design, robot_file: robot.path.clone() })
}

#[pymethods]
impl PyDesign {
    /// What the program prints: what the motion is for, and what it brings.
    fn text(&self) -> &str {
        self.design.text()
    }

    /// What is to be settled, and the log evidence (nats) of the logs at hand and of the motion.
    #[getter]
    fn worth(&self) -> Vec<(String, f64, Option<f64>)> {
        self.design.worth()
    }

    /// The motion, with the torque to expect; none where no motion helps.
    #[getter]
    fn log(&self) -> Option<PyLog> {
        self.design.run().map(PyLog::of_run)
    }

    /// Writes motion.csv, motion.parquet and motion.toml; says where, and nothing where no motion helps.
    fn save(&self, folder: PathBuf) -> PyResult<Option<String>> {
        self.design.write(&folder, &self.robot_file).map_err(exception)
    }
}
