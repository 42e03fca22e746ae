use std::path::PathBuf;

use cli::{CliError, Replays, hashes_of, provenance_of};
use logs::{PrepareSettings, prepare};
use numpy::PyArray1;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::error::exception;
use crate::log::PyLog;
use crate::robot::PyRobot;
use crate::work::run;

/// The simulation of a robot beside recorded runs.
#[pyclass(frozen, name = "Replay", module = "plumbline")]
pub struct PyReplay {
    replays: Replays,
    doubts: Vec<String>,
}

/// Rolls the simulation of `robot` forward under the torque of every log, and lets it follow the recorded motion.
///
/// # Errors
///
/// [`crate::error::PlumblineError`] for logs that cannot be used and a robot that cannot be simulated, `ValueError` for a
/// length of time that is not positive.
#[pyfunction]
#[pyo3(signature = (robot, logs, *, window_ms, progress=None))]
pub fn replay(
    py: Python<'_>,
    robot: &PyRobot,
    logs: Vec<PyRef<'_, PyLog>>,
    window_ms: Vec<f64>,
    progress: Option<Py<PyAny>>,
) -> PyResult<PyReplay> {
    if let Some(ms) = window_ms.iter().find(|ms| !(ms.is_finite() && **ms > 0.0)) {
        let message = format!("window_ms: found {ms}, positive numbers were expected");
        return Err(PyValueError::new_err(message));
    }
    let loaded = &robot.loaded;
    let runs: Vec<_> = logs.iter().map(|log| log.run(&loaded.robot)).collect::<PyResult<_>>()?;
    let names: Vec<&str> = runs.iter().map(|run| run.name.as_str()).collect();
    let command = format!("plumbline.replay({}, [{}])", robot.path.display(), names.join(", "));
    let mut provenance =
        provenance_of(vec![command], &robot.path, loaded, None).map_err(exception)?;
    provenance.files.extend(hashes_of(&runs));
    let replays = run(py, progress.as_ref(), |work| {
        let (read, doubts) = cli::corrected_runs(loaded, &runs);
        let prepared = prepare(read.as_ref().unwrap_or(&runs), &PrepareSettings::default())
            .map_err(|error| Box::new(CliError::from(error)))?;
        work.stage("replaying (runs)", runs.len());
        let replays = Replays::new(loaded, prepared, &window_ms, provenance, &|| work.step())?;
        Ok::<_, Box<CliError>>(PyReplay { replays, doubts })
    })?;
    replays.map_err(|error| exception(*error))
}

#[pymethods]
impl PyReplay {
    /// Of every run its name, and of every length of time (ms) the RMS of the drift by joint (rad or m).
    fn drift<'py>(&self, py: Python<'py>) -> Vec<(String, Vec<Drift<'py>>)> {
        let vector = |drift: &Vec<f64>| PyArray1::from_slice(py, drift);
        let runs = self.replays.report.runs.iter();
        let of = |window: &report::ReplayedWindow| {
            (window.window_ms, window.drift_rms.as_ref().map(vector))
        };
        runs.map(|run| (run.name.clone(), run.windows.iter().map(of).collect())).collect()
    }

    /// Doubts about the input, in sentences.
    #[getter]
    fn doubts(&self) -> Vec<String> {
        self.doubts.clone()
    }

    /// `replay.json`.
    fn json(&self) -> PyResult<String> {
        self.replays.report.json().map_err(exception)
    }

    /// `report.html`.
    fn html(&self) -> PyResult<String> {
        self.replays.report.page().map_err(exception)
    }

    /// What the program prints.
    fn text(&self) -> String {
        self.replays.text()
    }

    /// Writes the files of the program's output folder.
    fn save(&self, folder: PathBuf) -> PyResult<()> {
        cli::create_folder(&folder).map_err(exception)?;
        self.replays.write(&folder).map_err(exception)
    }
}

/// A length of time (ms) and the RMS of the drift after it by joint; none where a joint ran away in all windows.
type Drift<'py> = (f64, Option<Bound<'py, PyArray1<f64>>>);
