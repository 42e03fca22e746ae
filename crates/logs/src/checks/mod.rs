//! Samples that no joint can have, and clocks and turns that are put right.

pub(crate) mod degrees;
pub(crate) mod even_clock;
pub(crate) mod impossible;
pub(crate) mod saturation;
pub(crate) mod turns;
