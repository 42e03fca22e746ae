//! What a scenario says of a motion, a kind a file, and how a motion is built from it.

pub(crate) mod chirp;
mod defaults;
pub(crate) mod fourier;
pub(crate) mod hold;
pub(crate) mod motion_spec;
pub(crate) mod ramp;
pub(crate) mod recorded;
pub(crate) mod rhythm;
mod sequence;
pub(crate) mod sinusoids;
pub(crate) mod sweep;
pub(crate) mod waypoints;
