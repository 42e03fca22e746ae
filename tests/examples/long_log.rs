//! Writes a log of the WAM of any length, seven joints at 500 Hz with position, velocity and effort, for
//! measurements of time and memory:
//!
//! ```text
//! cargo run --release -p checks --example long_log -- MINUTES LOG.parquet
//! ```
//!
//! The arm has dry friction of 0.6 N m at two joints and 1 kg in its hand; every sample has noise of its own.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a program for the desk may stop"
)]

use std::path::Path;

use checks::synthetic::{Noise, Truth, run_at, wam};

const RATE_HZ: f64 = 500.0;

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [minutes, file] = arguments.as_slice() else { panic!("MINUTES LOG.parquet was expected") };
    let minutes: f64 = minutes.parse().expect("MINUTES is a number");
    let mut loaded = wam();
    let palm = loaded.joint_count() - 1;
    loaded.link_mut(palm).unwrap().inertia.mass += 1.0;
    let friction = |j: usize, s: [f64; 3]| if j == 1 || j == 3 { 0.6 * s[1].signum() } else { 0.0 };
    let truth = Truth { robot: &loaded, torque: &friction, reading: &|_, effort| effort };
    let run = run_at(&truth, &Noise::of_a_wam(), [60.0 * minutes, RATE_HZ], 1);
    logs::write_parquet(Path::new(file), &run).unwrap();
}
