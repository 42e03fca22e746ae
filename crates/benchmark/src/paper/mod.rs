//! The figures of Nguyen-Tuong & Peters 2010 for the project's own arm, and whether the paper's claims hold there.

pub(crate) mod figure_spec;
pub(crate) mod learning_claims;
pub(crate) mod learning_errors;
pub(crate) mod learning_figure;
pub(crate) mod prediction_time_figure;
pub(crate) mod time_claims;
