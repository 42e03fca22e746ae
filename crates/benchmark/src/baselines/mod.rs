//! Two simple methods that a diagnosis is compared with.
//!
//! ```text
//! least_squares:  effort = Y pi + friction + offset + rotor,   all of it fitted, nominal forgotten
//! two_questions:  effort - nominal effort = sum over names of columns weights, names one by one
//! ```
//!
//! Neither uses the columns, the search or the statistics of the diagnosis. They share only the preparation of the
//! logs, the rigid bodies of `dynamics` and the names of the catalogue.
//!
//! - [`Baseline`] is the result of either method: names, and predicted efforts;
//! - `run_columns` is the motion of a run and every column along it, `shape` names the columns;
//! - `candidate` is a cause and its columns, `dataset` the columns of all runs and their sums;
//! - `fit` is least squares from sums, `folds` says which samples are kept apart.

pub(crate) mod baseline;
pub(crate) mod candidate;
pub(crate) mod competition;
pub(crate) mod dataset;
pub(crate) mod drive;
pub(crate) mod fit;
pub(crate) mod folds;
pub(crate) mod least_squares;
pub(crate) mod memory;
pub(crate) mod prepare_runs;
pub(crate) mod run_columns;
pub(crate) mod scales;
pub(crate) mod shape;
pub(crate) mod two_questions;
