//! The module `plumbline` of Python, and the program in it.
//!
//! ```text
//! arrays, frames, files -> Robot, Log -> diagnose -> findings, report, robots in other formats
//! ```
//!
//! Everything is computed where the program computes it; here stand the checks of what Python hands
//! over. The work goes on without the lock of the interpreter, on a thread that Ctrl-C ends.
#![allow(
    clippy::fn_params_excessive_bools,
    reason = "keywords of Python, which are named where they are given"
)]

mod arguments;
mod arrays;
mod comparison;
mod design;
mod diagnosis;
mod effect;
mod error;
mod inverse_dynamics;
mod log;
mod model;
mod program;
mod replay;
mod robot;
mod simulation;
mod tracking;
mod work;

/// What the Python package `plumbline` is made of.
#[pyo3::pymodule]
mod _plumbline {
    use pyo3::prelude::{Bound, PyModule, PyModuleMethods, PyResult};

    #[pymodule_export]
    use crate::comparison::{PyComparison, compare};
    #[pymodule_export]
    use crate::design::{PyDesign, design};
    #[pymodule_export]
    use crate::diagnosis::{PyDiagnosis, diagnose};
    #[pymodule_export]
    use crate::effect::{PyEffect, effects, explain};
    #[pymodule_export]
    use crate::error::PlumblineError;
    #[pymodule_export]
    use crate::inverse_dynamics::inverse_dynamics;
    #[pymodule_export]
    use crate::log::PyLog;
    #[pymodule_export]
    use crate::model::{PyModel, learn};
    #[pymodule_export]
    use crate::program::main;
    #[pymodule_export]
    use crate::replay::{PyReplay, replay};
    #[pymodule_export]
    use crate::robot::PyRobot;
    #[pymodule_export]
    use crate::simulation::{PySimulation, simulate};
    #[pymodule_export]
    use crate::tracking::{PyTracking, track};

    /// Adds the version, which is that of the program.
    #[pymodule_init]
    fn init(module: &Bound<'_, PyModule>) -> PyResult<()> {
        module.add("__version__", env!("CARGO_PKG_VERSION"))
    }
}
