//! Strangers that act on commands, against closed forms.

use crate::rig::{FINE, acting, flywheel, run};
use crate::strangers::arm;

/// Of the wheel with its rotor (kg m²).
const INERTIA: f64 = 0.5;

/// Times (s) and torques (N m) on a wheel under commands.
fn torques(stranger: &str, duration_s: f64, command: impl Fn(f64) -> f64) -> Vec<(f64, f64)> {
    let mut wheel = arm(&flywheel(0.4, 0.1), stranger, FINE);
    wheel.start(&[0.2]);
    acting(&run(&mut wheel, duration_s, |r| vec![command(r.time_s)]).unwrap(), INERTIA)
}

/// What comes of rounding: `I eps q / dt²`.
const ROUNDING: f64 = 1e-5;

#[test]
fn oracle_a_dead_zone_is_missing_from_every_command() {
    for width in [0.5, 0.0] {
        let stranger = format!("drive_dead_zone = {{ joint = 'joint', width_nm = {width:?} }}");
        for (command, expected) in
            [(0.4, if width > 0.0 { 0.0 } else { 0.4 }), (2.0, 2.0 - width), (-0.7, -0.7 + width)]
        {
            for (time_s, torque) in torques(&stranger, 0.05, |_| command) {
                assert!((torque - expected).abs() < ROUNDING, "{torque} at {time_s} s");
            }
        }
    }
}

/// A command that jumps by 2 N m at 10 ms is a ramp of 50 N m/s, up and down.
#[test]
fn oracle_a_limited_rate_makes_a_ramp_of_a_jump() {
    let stranger = "torque_rate_limit = { joint = 'joint', rate_nm_per_s = 50.0 }";
    for sign in [1.0, -1.0] {
        let command = |t: f64| if t < 0.00995 { 0.0 } else { 2.0 * sign };
        for (time_s, torque) in torques(stranger, 0.08, command) {
            let expected = sign * (50.0 * (time_s - 0.01)).clamp(0.0, 2.0);
            // Half a step and the step of the jump.
            assert!((torque - expected).abs() < 50.0 * 2e-4, "{torque} at {time_s} s");
        }
    }
    // With a reserve it starts where it is no further behind than that.
    let reserve = stranger.replace(" }", ", behind_nm = 0.7 }");
    for (time_s, torque) in torques(&reserve, 0.08, |t| if t < 0.00995 { 0.0 } else { 2.0 }) {
        let ramp = if time_s < 0.01005 { 0.0 } else { 1.3 + 50.0 * (time_s - 0.01) };
        let jumping = (time_s - 0.01).abs() < 1.5e-4;
        assert!(jumping || (torque - ramp.min(2.0)).abs() < 50.0 * 3e-4, "{torque} at {time_s} s");
    }
    let slow = |t: f64| 1.0 + 40.0 * t;
    for (time_s, torque) in torques(stranger, 0.05, slow).split_off(1) {
        assert!((torque - slow(time_s)).abs() < 40.0 * 1e-4, "{torque} at {time_s} s");
    }
}

/// Beginnings (s) and lengths (s) of the stretches with the lower torque.
fn gaps(samples: &[(f64, f64)], below: f64) -> Vec<(f64, f64)> {
    let mut gaps: Vec<(f64, f64)> = Vec::new();
    for pair in samples.windows(2) {
        let [(_, before), (time_s, now)] = [pair[0], pair[1]];
        if now < below && before >= below {
            gaps.push((time_s, 0.0));
        }
        if let (true, Some(gap)) = (now < below, gaps.last_mut()) {
            gap.1 = time_s + 1e-4 - gap.0;
        }
    }
    gaps
}

/// 40 s of 1 N m with 60 dropouts a minute of 50 ms: 40 of them, give or take three times their
/// root; each as long as one, those that overlap longer; nothing in between is missing.
#[test]
fn oracle_dropouts_take_the_torque_away_as_often_and_as_long_as_asked() {
    let stranger = |rate: f64, seed: u64| {
        format!(
            "torque_dropout = {{ joint = 'joint', per_minute = {rate:?}, length_ms = 50.0, kept = 0.25, seed = {seed} }}"
        )
    };
    // The wheel turns slowly about a place, so that positions keep their digits.
    let swing = |t: f64| if (t / 0.5).fract() < 0.5 { 1.0 } else { -1.0 };
    let held = |seed, rate| {
        let samples = torques(&stranger(rate, seed), 40.0, swing);
        samples.iter().map(|&(t, torque)| (t, torque / swing(t))).collect::<Vec<_>>()
    };
    let samples = held(1, 60.0);
    let odd = samples.iter().filter(|(_, x)| (x - 1.0).abs() > 1e-3 && (x - 0.25).abs() > 1e-3);
    // A jump of the command falls on the middle of a step.
    assert!(odd.count() < 400, "only all or a quarter of the torque");
    let gaps: Vec<_> = gaps(&samples, 0.5).into_iter().filter(|gap| gap.1 > 0.01).collect();
    let count = gaps.len() as f64;
    assert!((count - 40.0).abs() < 3.0 * 40.0_f64.sqrt(), "{count}");
    let whole = gaps.iter().filter(|gap| (gap.1 - 0.05).abs() < 1.5e-4).count();
    assert!(gaps.iter().all(|gap| gap.1 > 0.0498) && 2 * whole > gaps.len(), "{gaps:?}");
    assert_eq!(samples, held(1, 60.0));
    assert_ne!(samples, held(2, 60.0));
    assert!(held(1, 0.0).iter().filter(|(_, x)| *x < 0.5).count() < 400);
}

/// A command of 1 N m for 0.3 s, then -1 N m: wound up by `t / T` to the limit, back from there.
#[test]
fn oracle_windup_is_the_integral_of_the_command_up_to_its_limit() {
    let stranger = |limit: f64| {
        format!(
            "integrator_windup = {{ joint = 'joint', time_constant_s = 0.5, limit_nm = {limit:?} }}"
        )
    };
    let command = |t: f64| if t < 0.29995 { 1.0 } else { -1.0 };
    for (time_s, torque) in torques(&stranger(0.4), 0.8, command) {
        if (time_s - 0.3).abs() < 5e-4 {
            continue;
        }
        let wound = if time_s < 0.3 {
            (time_s / 0.5).min(0.4)
        } else {
            (0.4 - (time_s - 0.3) / 0.5).max(-0.4)
        };
        let expected = command(time_s) + wound;
        assert!((torque - expected).abs() < 5e-4, "{torque}, not {expected} at {time_s} s");
    }
    for (time_s, torque) in torques(&stranger(0.0), 0.1, |_| 1.0) {
        assert!((torque - 1.0).abs() < ROUNDING, "{torque} at {time_s} s");
    }
}
