//! What the logs can be asked for: joints that move, readings that can be, second encoders that
//! follow.

pub(crate) mod at_limits;
pub(crate) mod extent;
pub(crate) mod inspected;
pub(crate) mod second_encoders;
