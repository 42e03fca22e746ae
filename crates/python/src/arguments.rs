use catalogue::EffectKind;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::error::exception;

/// A positive number, or none.
///
/// # Errors
///
/// `ValueError` that names the argument.
pub fn positive(name: &str, value: Option<f64>) -> PyResult<Option<f64>> {
    match value {
        Some(x) if !(x.is_finite() && x > 0.0) => {
            Err(PyValueError::new_err(format!("{name}: found {x}, a positive number was expected")))
        }
        other => Ok(other),
    }
}

/// Effects by name or code.
///
/// # Errors
///
/// [`crate::error::PlumblineError`] for a name that the catalogue lacks.
pub fn effects(names: &[String]) -> PyResult<Vec<EffectKind>> {
    names.iter().map(|name| cli::find_effect(name).map_err(exception)).collect()
}
