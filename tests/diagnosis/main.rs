//! The diagnosis on logs whose cause is known, and on recorded ones.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a broken fixture should stop the test")]

mod blind;
mod clean;
mod extended;
mod false_alarms;
mod found;
mod intervals;
mod recorded;
mod repeatable;
mod rivals;
mod together;
mod trials;
mod world;
