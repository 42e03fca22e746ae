//! The simulated arm against closed forms and other programs.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

mod coulomb_friction;
mod rig;
