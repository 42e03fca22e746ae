//! Gaussian processes against other programs and closed forms, and every model of the torque
//! against what all of them promise.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on should stop where it is")]

mod arm;
mod conformance;
mod golden;
mod golden_torques;
mod long_memory;
mod recorded;
mod semiparametric;
mod streamed;
