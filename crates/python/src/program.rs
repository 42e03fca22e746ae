use std::ffi::OsString;

use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

/// Runs the program with a command line, whose first argument is its own file, and gives its exit code.
#[pyfunction]
pub fn main(py: Python<'_>, command_line: Vec<OsString>) -> u8 {
    py.detach(|| cli::main(command_line))
}

/// A value as JSON.
pub fn json_of(value: &impl serde::Serialize) -> PyResult<String> {
    serde_json::to_string(value).map_err(|e| PyValueError::new_err(e.to_string()))
}
