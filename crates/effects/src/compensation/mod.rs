//! What undoes the effects that a robot's description holds.

pub(crate) mod feedforward;
pub(crate) mod lead;
pub(crate) mod left_out;
pub(crate) mod remedy;
