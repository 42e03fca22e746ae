//! What models of the torque are worth as feedforward: runs that follow one motion side by side.

pub(crate) mod comparison;
pub(crate) mod error_chart;
pub(crate) mod keys;
pub(crate) mod motion_chart;
pub(crate) mod page;
#[cfg(test)]
pub(crate) mod sample;
pub(crate) mod sentence;
pub(crate) mod sweep_chart;
pub(crate) mod table;
