//! From plant to gain: what is written of it, read back.
#![allow(clippy::unwrap_used, clippy::panic, reason = "tests may stop at the first surprise")]

mod recorded_diagnosis;
