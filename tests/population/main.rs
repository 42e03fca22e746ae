//! The population: trials as workshops vary, drawn from seeds, and what is true of them.
#![allow(clippy::unwrap_used, clippy::panic, reason = "tests may stop at the first surprise")]

mod bench;
mod field;
mod instruments;
mod log_kinds;
mod made;
mod recorded;
mod spec;
mod store;
