//! Models learned from logs: of the torque, and of the residual of a diagnosis.

pub(crate) mod learned;
pub(crate) mod median_time;
pub(crate) mod relevance;
pub(crate) mod residual;
