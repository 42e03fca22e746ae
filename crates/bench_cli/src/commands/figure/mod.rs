//! A figure of the paper, drawn from its scenario.

pub mod arguments;
pub mod draw;
mod learning;
mod prediction_time;
