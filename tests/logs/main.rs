//! Logs: files, checks, filters, preparation, and the recorded logs where they are at hand.
#![allow(clippy::unwrap_used, reason = "a helper that fails is a test that fails")]

mod bad_input;
mod files;
mod filter;
mod growing;
mod info;
mod preparation;
mod recorded;
mod support;
