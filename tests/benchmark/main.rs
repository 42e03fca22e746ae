//! Campaigns of blind trials: made, scored by the truth, compared; and the baselines.
#![allow(clippy::unwrap_used, clippy::panic, reason = "tests may stop at the first surprise")]

mod account;
mod alarms;
mod baselines;
mod campaign;
mod cause_bench;
mod made_up;
mod paired;
mod panel;
mod scores;
mod small_panel;
mod trials;
