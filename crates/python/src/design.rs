use std::path::{Path, PathBuf};

use cli::{DiagnosisFile, SearchedMotion, WantedMotion};
use next_motion::Settings;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::arguments::positive;
use crate::diagnosis::Diagnosis;
use crate::error::raised;
use crate::log::Log;
use crate::robot::Robot;
use crate::work::run;

/// The motion that settles what a diagnosis left open.
#[pyclass(frozen, module = "plumbline")]
pub struct Design {
    searched: SearchedMotion,
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
    robot: &Robot,
    diagnosis: Option<&Diagnosis>,
    separate: Option<[String; 2]>,
    duration_s: Option<f64>,
    seed: Option<u64>,
    progress: Option<Py<PyAny>>,
) -> PyResult<Design> {
    if diagnosis.is_none() && separate.is_none() {
        let words = "diagnosis: found None, one was expected where separate names no two causes";
        return Err(PyValueError::new_err(words));
    }
    let defaults = Settings::default();
    let settings = Settings {
        duration_s: positive("duration_s", duration_s)?.unwrap_or(defaults.duration_s),
        seed: seed.unwrap_or(defaults.seed),
    };
    let read = |diagnosis: &Diagnosis| {
        let name = Path::new("diagnosis");
        DiagnosisFile::parse(&diagnosis.json()?, name, &robot.loaded.robot).map_err(raised)
    };
    let file = diagnosis.map(read).transpose()?;
    let wanted = WantedMotion {
        loaded: &robot.loaded,
        diagnosed: file.as_ref().zip(diagnosis.map(Diagnosis::runs)),
        separate: separate.as_ref().map(|pair| pair.each_ref().map(String::as_str)),
        settings,
    };
    let searched = run(py, progress.as_ref(), |work| {
        work.stage("searching a motion", 0);
        SearchedMotion::new(&wanted).map_err(Box::new)
    })?;
    let searched = searched.map_err(|error| raised(*error))?;
    Ok(Design { searched, robot_file: robot.path.clone() })
}

#[pymethods]
impl Design {
    /// What the program prints: what the motion is for, and what it brings.
    fn text(&self) -> &str {
        self.searched.text()
    }

    /// What is to be settled, and the log evidence (nats) of the logs at hand and of the motion.
    #[getter]
    fn worth(&self) -> Vec<(String, f64, Option<f64>)> {
        self.searched.worth()
    }

    /// The motion, with the torque to expect; none where no motion helps.
    #[getter]
    fn log(&self) -> Option<Log> {
        self.searched.run().map(Log::of_run)
    }

    /// Writes motion.csv, motion.parquet and motion.toml; says where, and nothing where no motion helps.
    fn save(&self, folder: PathBuf) -> PyResult<Option<String>> {
        self.searched.write(&folder, &self.robot_file).map_err(raised)
    }
}
