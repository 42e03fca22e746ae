//! Which parts of the logs can be used: joints that move, corrected readings, second encoders that follow their
//! motors.

pub(crate) mod at_limits;
pub(crate) mod extent;
pub(crate) mod inspected_logs;
pub(crate) mod second_encoders;
