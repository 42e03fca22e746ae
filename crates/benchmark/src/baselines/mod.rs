//! A simple method that a diagnosis is compared with: plain least squares.
//!
//! ```text
//! least_squares:  effort = Y pi + friction + offset + rotor,   all of it fitted, nominal forgotten
//! ```
//!
//! It uses neither the columns, nor the search, nor the statistics of the diagnosis. They share only the preparation of
//! the logs, the rigid bodies of `dynamics` and the names of the catalogue.
//!
//! - [`Baseline`] is its result: names, and predicted efforts;
//! - `run_columns` is the motion of a run and every column along it, `shape` names the columns;
//! - `dataset` is the columns of all runs and their sums, `fit` is least squares from sums.

pub(crate) mod baseline;
pub(crate) mod dataset;
pub(crate) mod fit;
pub(crate) mod least_squares;
pub(crate) mod memory;
pub(crate) mod prepare_runs;
pub(crate) mod run_columns;
pub(crate) mod scales;
pub(crate) mod shape;
