//! The figures of Nguyen-Tuong & Peters 2010 on the project's own arm, and what holds of the
//! claims that are made of them.

mod error_tables;
mod learning_figure;
mod page;
mod prediction_time_figure;
#[cfg(test)]
pub(crate) mod sample;

pub use learning_figure::{LEARNING_FIGURE_SCHEMA, LearningFigureReport};
pub use prediction_time_figure::{PREDICTION_TIME_FIGURE_SCHEMA, PredictionTimeFigureReport};
