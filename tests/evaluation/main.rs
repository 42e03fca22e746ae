//! Scenarios put to work: what is written of them, read back, and blind trials scored.
#![allow(clippy::unwrap_used, clippy::panic, reason = "tests may stop at the first surprise")]

mod campaign;
mod recorded_diagnosis;
mod scores;
mod trials;
