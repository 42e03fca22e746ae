//! A robot along the logs: measured and expected efforts, low-passed alike and at one rate. Oscillations and clipped
//! efforts are separated.

pub(crate) mod along;
pub(crate) mod first_samples;
pub(crate) mod left_over;
pub(crate) mod limit;
pub(crate) mod log;
pub(crate) mod response;
pub(crate) mod rest;
pub(crate) mod tone;
