//! Turns runs into filtered signals on a uniform clock, and estimates the noise in them.

pub(crate) mod agreement;
pub(crate) mod choice;
pub(crate) mod clock;
pub(crate) mod cutoff;
pub(crate) mod differentiate;
pub(crate) mod filter;
pub(crate) mod filtered;
pub(crate) mod fourier_transform;
pub(crate) mod held;
pub(crate) mod lattice;
pub(crate) mod link_lag;
pub(crate) mod motion_band;
pub(crate) mod noise;
pub(crate) mod noise_readings;
pub(crate) mod origin;
pub(crate) mod prepare;
pub(crate) mod prepared;
pub(crate) mod rest;
pub(crate) mod sources;
pub(crate) mod spectrum;
pub(crate) mod uniform;
pub(crate) mod warning;
