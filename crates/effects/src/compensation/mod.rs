//! Compensation of the effects in a robot's description.

pub(crate) mod feedforward;
pub(crate) mod lead;
pub(crate) mod left_out;
pub(crate) mod remedy;
