use std::path::{Path, PathBuf};

use cli::{TrackingRequest, TrackingResult};
use experiment::FeedforwardKind;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::error::exception;
use crate::work::run;

/// A motion tracked by a simulated arm, with the torque of models fed forward.
#[pyclass(frozen, name = "Tracking", module = "plumbline")]
pub struct PyTracking {
    result: TrackingResult,
    out: Option<PathBuf>,
}

/// Tracks the motion of a scenario with every feedforward and compares them.
///
/// # Errors
///
/// `ValueError` for a feedforward that there is not, [`crate::error::PlumblineError`] for a scenario, models or an
/// arm that cannot be used.
#[pyfunction]
#[pyo3(signature = (
    scenario, out=None, *, learned=None, feedforward=Vec::new(), set=Vec::new(), progress=None
))]
pub fn track(
    py: Python<'_>,
    scenario: PathBuf,
    out: Option<PathBuf>,
    learned: Option<PathBuf>,
    feedforward: Vec<String>,
    set: Vec<String>,
    progress: Option<Py<PyAny>>,
) -> PyResult<PyTracking> {
    let command = command(&scenario, learned.as_deref(), &feedforward, &set);
    let kind = |name: &String| {
        let wrong = |reason: String| PyValueError::new_err(format!("feedforward: {reason}"));
        name.parse::<FeedforwardKind>().map_err(wrong)
    };
    let feedforward: Vec<FeedforwardKind> =
        feedforward.iter().map(kind).collect::<PyResult<_>>()?;
    let request = TrackingRequest {
        scenario: &scenario,
        set: &set,
        feedforward: &feedforward,
        learned: learned.as_deref(),
        out: out.as_deref(),
        live: false,
        command: Some(command),
    };
    let result =
        run(py, progress.as_ref(), |work| TrackingResult::new(&request, work).map_err(Box::new))?;
    let result = result.map_err(|error| exception(*error))?;
    if let Some(out) = &out {
        result.write(out).map_err(exception)?;
    }
    Ok(PyTracking { result, out })
}

/// The command line of the program that does the same.
fn command(
    scenario: &Path,
    learned: Option<&Path>,
    feedforward: &[String],
    set: &[String],
) -> Vec<String> {
    let shown = |path: &Path| path.display().to_string();
    let mut command = vec!["plumbline".to_owned(), "track".to_owned(), shown(scenario)];
    if let Some(folder) = learned {
        command.extend(["--learned".to_owned(), shown(folder)]);
    }
    if !feedforward.is_empty() {
        command.extend(["--feedforward".to_owned(), feedforward.join(",")]);
    }
    command.extend(set.iter().flat_map(|one| ["--set".to_owned(), one.clone()]));
    command
}

#[pymethods]
impl PyTracking {
    /// `tracking.json`.
    fn json(&self) -> PyResult<String> {
        self.result.comparison().json().map_err(exception)
    }

    /// What the program prints.
    fn text(&self) -> String {
        self.result.comparison().text()
    }

    /// `report.html`.
    fn html(&self) -> PyResult<String> {
        self.result.comparison().page().map_err(exception)
    }

    /// The folder that was written, if one was.
    #[getter]
    fn out(&self) -> Option<PathBuf> {
        self.out.clone()
    }
}
