//! What came of a run of a scenario: what was put in, what was found, what finding it gains.

mod charts;
mod hidden;
mod page;
mod rows;
mod run_report;
#[cfg(test)]
pub(crate) mod sample;
mod text;
mod told;

pub use run_report::{RUN_SCHEMA, RunReport};
pub use told::{Told, told};
