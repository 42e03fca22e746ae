//! Velocity and acceleration are the derivatives of the position, and continuous.

use checks::synthetic::wam;
use motion::Motion;
use proptest::prelude::*;

use crate::support::{build, every_kind};

/// Half the step of a central difference (s). With third derivatives up to 1e3 rad/s³ and
/// positions to 1e-15 it is within 2e-8 rad/s of the derivative.
const STEP_S: f64 = 1e-5;
const TOLERANCE: f64 = 2e-6;

fn largest_error(motion: &Motion, time_s: f64) -> f64 {
    let [before, now, after] = [-STEP_S, 0.0, STEP_S].map(|h| motion.at(time_s + h));
    let mut largest: f64 = 0.0;
    for joint in 0..motion.joint_count() {
        let slope = |x: &[f64], y: &[f64]| (y[joint] - x[joint]) / (2.0 * STEP_S);
        largest = largest
            .max((slope(&before.q, &after.q) - now.qd[joint]).abs())
            .max((slope(&before.qd, &after.qd) - now.qdd[joint]).abs());
    }
    largest
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(40))]

    #[test]
    fn velocity_and_acceleration_are_central_differences_of_every_kind(
        seed in 0_u64..1_000_000,
        share in 0.0..1.0_f64,
    ) {
        let wam = wam();
        for (kind, toml) in every_kind(seed) {
            let motion = build(&wam, &toml).unwrap();
            let error = largest_error(&motion, share * motion.duration_s());
            // Where the jerk jumps, between two pieces, a difference is wrong by the step.
            prop_assert!(error < TOLERANCE + 100.0 * STEP_S, "{kind}: {error:e}");
        }
    }
}

#[test]
fn on_a_dense_clock_nearly_every_difference_is_exact() {
    let wam = wam();
    for (kind, toml) in every_kind(11) {
        let motion = build(&wam, &toml).unwrap();
        let count = 2_000;
        let at = |k: i32| motion.duration_s() * (f64::from(k) + 0.3) / f64::from(count);
        let wrong = (0..count).filter(|&k| largest_error(&motion, at(k)) > TOLERANCE).count();
        assert!(wrong < 5, "{kind}: {wrong} of {count} differences");
    }
}

#[test]
fn every_kind_starts_and_ends_at_rest() {
    let wam = wam();
    for (kind, toml) in every_kind(3) {
        let motion = build(&wam, &toml).unwrap();
        for time in [0.0, motion.duration_s()] {
            let state = motion.at(time);
            let moves = state.qd.iter().chain(&state.qdd).any(|x| x.abs() > 1e-9);
            assert!(!moves, "{kind} at {time} s: {state:?}");
        }
    }
}

#[test]
fn without_a_fade_a_periodic_motion_starts_in_motion() {
    let toml = crate::support::sinusoids(1) + "fade_s = 0.0\n";
    let motion = build(&wam(), &toml).unwrap();
    assert!(motion.at(0.0).qd.iter().any(|qd| qd.abs() > 0.1));
}
