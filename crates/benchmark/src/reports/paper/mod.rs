//! Reports of the figures of Nguyen-Tuong & Peters 2010 and of the paper's claims about them.

pub(crate) mod error_tables;
pub(crate) mod learning_figure;
pub(crate) mod page;
pub(crate) mod prediction_time_figure;
#[cfg(test)]
pub(crate) mod sample;
