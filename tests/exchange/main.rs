//! A robot in the files of other programs: what they hold, and what the programs make of it.
#![allow(clippy::unwrap_used, reason = "helper functions of a test may fail loudly")]
#![allow(clippy::float_cmp, reason = "numbers that pass through a file unchanged are equal")]

mod files;
mod follows_goals;
mod held;
mod held_out;
mod hostile_names;
mod mujoco;
mod newton;
mod python;
mod rich;
mod servos;
mod written_back;
