//! Logs: files, checks, filters, preparation, and the recorded logs where they are at hand.
#![allow(clippy::unwrap_used, reason = "a helper that fails is a test that fails")]
#![allow(clippy::float_cmp, reason = "numbers that pass through a file unchanged are equal")]

mod bad_input;
mod bags;
mod bounds;
mod damage;
mod dates;
mod dialects;
mod estimators;
mod excerpt;
mod files;
mod filter;
mod growing;
mod hdf5;
mod info;
mod joined;
mod kinds;
mod lerobot;
mod link_lag;
mod many_arrays;
mod maps;
mod matlab;
mod noise;
mod numpy;
mod packed;
mod preparation;
mod recorded;
mod smoother;
mod support;
mod survey;
