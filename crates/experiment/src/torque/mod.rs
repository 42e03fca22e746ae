//! Errors of predicted torque in the band of the motion.

pub(crate) mod band;
pub(crate) mod torque_error;
pub(crate) mod turning_error;
