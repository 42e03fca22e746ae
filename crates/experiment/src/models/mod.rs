//! What is learned from logs: models of the torque, and a process of what a diagnosis leaves.

pub(crate) mod learned;
pub(crate) mod median_time;
pub(crate) mod relevance;
pub(crate) mod residual;
