//! Two plain methods that a diagnosis is measured against.
//!
//! ```text
//! least_squares:  effort = Y pi + friction + offset + rotor,   all of it fitted, nominal forgotten
//! two_questions:  effort - nominal effort = sum over names of columns weights, names one by one
//! ```
//!
//! Neither uses the columns, the search or the statistics of the diagnosis: what is compared with
//! it shares the log's preparation, the rigid bodies of `dynamics` and the names of the catalogue.
//!
//! - [`Baseline`] is what either makes of logs: names, and efforts that it predicts;
//! - `sight` is the motion of a run and every column along it, `shape` names the columns;
//! - `candidate` is a cause and its columns, `gathered` the columns of all runs and their sums;
//! - `fit` is least squares from sums, `folds` says which samples are kept apart.

mod band;
mod baseline;
mod candidate;
mod contest;
mod drive;
mod fit;
mod folds;
mod gathered;
mod least_squares;
mod memory;
mod prepared;
mod scales;
mod shape;
mod sight;
mod two_questions;

pub(crate) use band::Band;
pub use baseline::Baseline;
pub use least_squares::least_squares;
pub use two_questions::two_questions;

pub use crate::torque_error::robot_error;
