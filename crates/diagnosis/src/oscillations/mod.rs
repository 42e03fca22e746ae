//! Findings outside the regression: lines of the spectrum over time and over position, and limits of the efforts.

pub(crate) mod arrow_matrix;
pub(crate) mod limits;
pub(crate) mod lines;
pub(crate) mod moving_runs;
pub(crate) mod run_parts;
pub(crate) mod spectral_lines;
pub(crate) mod tone_fit;
pub(crate) mod tones;
pub(crate) mod turning_sum;
