//! What learned models are worth: their errors side by side, and the time of a prediction.

pub(crate) mod comparison;
pub(crate) mod error_chart;
pub(crate) mod page;
#[cfg(test)]
pub(crate) mod sample;
pub(crate) mod table;
pub(crate) mod time_chart;
pub(crate) mod times;
