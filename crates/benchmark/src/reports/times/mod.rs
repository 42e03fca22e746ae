//! The time of one prediction against the number of training points.

pub(crate) mod prediction_times;
pub(crate) mod time_chart;
