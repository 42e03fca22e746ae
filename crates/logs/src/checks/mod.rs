//! Impossible samples, positions in degrees, and the repair of clocks and full turns.

pub(crate) mod degrees;
pub(crate) mod even_clock;
pub(crate) mod impossible;
pub(crate) mod lost_efforts;
pub(crate) mod saturation;
pub(crate) mod turns;
