//! Recorded runs: their signals, the repairs made in them, and repeated recordings.

pub(crate) mod duplicate;
pub(crate) mod repair;
pub(crate) mod run;
pub(crate) mod session;
pub(crate) mod stretches;
