//! Impossible samples, positions in degrees, clocks that do not count in seconds, and the repair of clocks and full turns.

pub(crate) mod clocks;
pub(crate) mod degrees;
pub(crate) mod even_clock;
pub(crate) mod impossible;
pub(crate) mod lost_efforts;
pub(crate) mod saturation;
pub(crate) mod turns;
