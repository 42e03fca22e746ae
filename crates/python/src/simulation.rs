use std::path::PathBuf;

use document::Document;
use pyo3::prelude::*;
use simulator::LogFormat;
use simulator::scenario::Scenario;

use crate::error::exception;
use crate::log::PyLog;
use crate::robot::PyRobot;
use crate::work::run;

/// The runs of a scenario, simulated.
#[pyclass(frozen, name = "Simulation", module = "plumbline")]
pub struct PySimulation {
    scenario: Scenario,
    simulation: simulator::Simulation,
}

/// Simulates every run of a scenario; the same seed gives the same logs.
///
/// # Errors
///
/// [`crate::error::PlumblineError`] for a scenario that cannot be read or simulated.
#[pyfunction]
#[pyo3(signature = (scenario, *, seed=None, set=Vec::new(), progress=None))]
pub fn simulate(
    py: Python<'_>,
    scenario: PathBuf,
    seed: Option<u64>,
    set: Vec<String>,
    progress: Option<Py<PyAny>>,
) -> PyResult<PySimulation> {
    let mut document = Document::read(&scenario).map_err(exception)?;
    set.iter().try_for_each(|assignment| document.set(assignment)).map_err(exception)?;
    if let Some(seed) = seed {
        document.set(&format!("seed={seed}")).map_err(exception)?;
    }
    let scenario = Scenario::from_document(&document).map_err(exception)?;
    let seconds: f64 = scenario.runs().iter().map(|run| run.motion.duration_s()).sum();
    let simulation = run(py, progress.as_ref(), |work| {
        work.stage("simulating (seconds of motion)", seconds as usize);
        simulator::simulate(&scenario, &|| work.step())
    })?;
    Ok(PySimulation { scenario, simulation: simulation.map_err(exception)? })
}

#[pymethods]
impl PySimulation {
    /// The logs, which tell nothing of what was put in.
    #[getter]
    fn logs(&self) -> Vec<PyLog> {
        self.simulation.runs.iter().cloned().map(PyLog::of_run).collect()
    }

    /// The robot as its files describe it, without what was put in.
    #[getter]
    fn robot(&self) -> PyResult<PyRobot> {
        PyRobot::read(self.scenario.robot_file())
    }

    /// Writes the logs, the whole scenario and, apart from them, what was put in.
    #[pyo3(signature = (folder, *, csv=false))]
    fn save(&self, folder: PathBuf, csv: bool) -> PyResult<()> {
        std::fs::create_dir_all(&folder)?;
        let format = if csv { LogFormat::Csv } else { LogFormat::Parquet };
        simulator::write(&folder, &self.scenario, &self.simulation, format).map_err(exception)
    }
}
