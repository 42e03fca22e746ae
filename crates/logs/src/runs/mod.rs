//! Recorded runs: their signals, what was put right in them, which of them are alike.

pub(crate) mod duplicate;
pub(crate) mod repair;
pub(crate) mod run;
pub(crate) mod session;
pub(crate) mod stretches;
