use pyo3::prelude::*;

use crate::diagnosis::{DiagnosisRequest, PyDiagnosis};
use crate::error::exception;
use crate::log::PyLog;
use crate::program::json_of;
use crate::robot::PyRobot;
use crate::work::run;

/// What changed from one set of logs to another.
#[pyclass(frozen, name = "Comparison", module = "plumbline", get_all)]
pub struct PyComparison {
    /// What the first logs say of the robot.
    before: Py<PyDiagnosis>,
    /// What the others say of the robot as the first found it: its findings are the changes.
    after: Py<PyDiagnosis>,
    /// As JSON the oscillations that both show with the same amplitude, which are no change.
    alike: String,
    /// What the program prints.
    text: String,
}

/// Names what changed from the logs `before` to the logs `after`.
///
/// # Errors
///
/// [`crate::error::PlumblineError`] for logs that cannot be used, and for one that is in both.
#[pyfunction]
#[pyo3(signature = (robot, before, after, *, cutoff_hz=None, without=Vec::new(), progress=None))]
pub fn compare(
    py: Python<'_>,
    robot: &PyRobot,
    before: Vec<PyRef<'_, PyLog>>,
    after: Vec<PyRef<'_, PyLog>>,
    cutoff_hz: Option<f64>,
    without: Vec<String>,
    progress: Option<Py<PyAny>>,
) -> PyResult<PyComparison> {
    let request = |logs| DiagnosisRequest {
        function: "compare",
        robot,
        logs,
        cutoff_hz,
        without: &without,
        only_findings: false,
    };
    let (first, other) = (request(before), request(after));
    let (runs, settings) = ([first.runs()?, other.runs()?], first.settings()?);
    let origins = [first.provenance(&runs[0])?, other.provenance(&runs[1])?];
    let inputs = [first.input(), other.input()];
    let about = &robot.loaded.robot;
    let sets = [runs[0].as_slice(), runs[1].as_slice()];
    let compared =
        run(py, progress.as_ref(), |work| ::diagnosis::compare(about, sets, &settings, work))?;
    let compared = compared.map_err(exception)?;
    let (alike, text) = (json_of(&compared.alike)?, cli::comparison_text(&compared));
    let extended = robot.with_robot(compared.before.extended.clone());
    let ([before, after], [origin, other], [input, other_input]) = (runs, origins, inputs);
    let before = PyDiagnosis::new(py, robot, before, compared.before, None, origin, input)?;
    let after = PyDiagnosis::new(py, &extended, after, compared.after, None, other, other_input)?;
    Ok(PyComparison { before: Py::new(py, before)?, after: Py::new(py, after)?, alike, text })
}
