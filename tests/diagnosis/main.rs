//! The diagnosis on logs whose cause is known, and on recorded ones.
#![allow(clippy::unwrap_used, reason = "a broken fixture should stop the test")]

mod clean;
