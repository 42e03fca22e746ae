//! Support for the tests: synthetic logs, recorded logs where they are present.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    reason = "a broken helper should stop the test that uses it"
)]

#[cfg(feature = "fuzz")]
extern crate self as checks;

pub mod arms;
pub mod book;
#[cfg(feature = "fuzz")]
#[path = "../readers/fuzz.rs"]
pub mod fuzz;
pub mod golden;
pub mod hostile_names;
pub mod lerobot;
pub mod mutated;
pub mod named_keys;
pub mod program;
pub mod recorded;
pub mod round;
pub mod spliced;
pub mod synthetic;
#[cfg(feature = "fuzz")]
#[path = "../readers/targets.rs"]
pub mod targets;
pub mod watch;
