use catalogue::EffectKind;
use pyo3::prelude::*;

use crate::error::exception;

/// What is known of an effect.
#[pyclass(frozen, name = "Effect", module = "plumbline", get_all)]
pub struct PyEffect {
    /// Its code, such as `FR02`.
    code: String,
    /// Its name, such as `coulomb_friction`.
    name: String,
    /// Names of its facts and parameters, and what each is.
    facts: Vec<(String, String)>,
    /// What the program prints.
    text: String,
}

impl PyEffect {
    fn new(kind: EffectKind) -> Self {
        let entry = kind.entry();
        let facts = cli::effect_facts(entry);
        Self {
            code: kind.code().to_owned(),
            name: kind.name().to_owned(),
            facts: facts.into_iter().map(|(name, fact)| (name.to_owned(), fact)).collect(),
            text: cli::plain_explanation(entry),
        }
    }
}

/// What is known of the effect of a code or name.
///
/// # Errors
///
/// [`crate::error::PlumblineError`] for a name that the catalogue lacks.
#[pyfunction]
pub fn explain(effect: &str) -> PyResult<PyEffect> {
    Ok(PyEffect::new(cli::find_effect(effect).map_err(exception)?))
}

/// Every effect of the catalogue.
#[pyfunction]
pub fn effects() -> Vec<PyEffect> {
    EffectKind::ALL.into_iter().map(PyEffect::new).collect()
}
