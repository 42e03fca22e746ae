//! Tracking with low gains on the simulated arm: what each model gains, and that a run can be
//! trusted and repeated.
#![allow(clippy::unwrap_used, clippy::panic, reason = "tests may stop at the first surprise")]

mod amplitude;
mod bench;
mod models;
mod perfect;
mod repeatable;
