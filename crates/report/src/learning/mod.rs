//! What learned models are worth: their errors side by side, and the time of a prediction.

mod comparison;
mod error_chart;
mod page;
#[cfg(test)]
pub(crate) mod sample;
mod table;
mod time_chart;
mod times;

pub use comparison::{ComparedJoint, Comparison, DataSet, KernelRow, LEARNING_SCHEMA, ModelRow};
pub use times::{Curve, Maker, PredictionTimes, TIMES_SCHEMA, TimePoint};
