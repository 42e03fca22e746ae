//! A run of a scenario: what was put in, what was found, what finding it gains.

pub(crate) mod charts;
pub(crate) mod claims;
pub(crate) mod diagnosis_summary;
pub(crate) mod hidden;
pub(crate) mod page;
pub(crate) mod rows;
pub(crate) mod run_report;
#[cfg(test)]
pub(crate) mod sample;
pub(crate) mod text;
