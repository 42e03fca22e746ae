//! What is told of whole logs before causes are sought.
#![allow(clippy::unwrap_used, clippy::panic, reason = "tests may stop at the first surprise")]

mod arms_with_friction;
mod axis_turned;
mod counted_together;
mod effort_units;
mod locked_elsewhere;
mod recorded;
mod spoil;
mod spoilt;
mod store;
mod without_gravity;
