//! Scenarios put to work: what is written of them, read back, and blind trials scored.
#![allow(clippy::unwrap_used, clippy::panic, reason = "tests may stop at the first surprise")]

mod baselines;
mod campaign;
mod made_up;
mod paired;
mod panel;
mod recorded_diagnosis;
mod scores;
mod small_panel;
mod trials;
