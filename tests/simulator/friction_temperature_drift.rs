use crate::rig::{STEPPING, flywheel, run, simulator};

const INERTIA: f64 = 0.5;
const SHARE: f64 = 0.6;
const TIME_CONSTANT: f64 = 1.5;

fn warming(joint: &str, friction: &str) -> String {
    format!(
        "[[effect]]\n{friction}\n[[effect]]\nfriction_temperature_drift = \
         {{ {joint} share = {SHARE}, time_constant_s = {TIME_CONSTANT} }}"
    )
}

/// Integral from 0 to `t` of the share of friction that is left, `1 - share (1 - exp(-t / T))`.
fn left(t: f64) -> f64 {
    (1.0 - SHARE) * t + SHARE * TIME_CONSTANT * (1.0 - (-t / TIME_CONSTANT).exp())
}

/// `I qdd = -c left(t) qd`, so `qd = qd(0) exp(-c / I integral of left)`.
#[test]
fn oracle_a_wheel_slows_down_by_viscous_friction_that_fades_exponentially() {
    let viscous = "viscous_friction = { joint = 'joint', viscous_nm_s_per_rad = 0.5 }";
    for joint in ["", "joint = 'joint',"] {
        let effects = warming(joint, viscous);
        let mut wheel = simulator(&flywheel(0.4, 0.1), &effects, STEPPING).unwrap();
        wheel.start_moving(&[0.0], &[3.0]);
        for row in run(&mut wheel, 4.0, |_| vec![0.0]).unwrap() {
            let expected = 3.0 * (-0.5 / INERTIA * left(row.time_s)).exp();
            let found = row.qd_true[0];
            assert!((found - expected).abs() < 2e-4, "{} s: {found}", row.time_s);
        }
    }
}

/// `I qdd = -level left(t)`, for the engine's dry friction, even with two levels, and for
/// bristles once they slide.
#[test]
fn oracle_dry_friction_and_bristles_fade_alike() {
    let coulomb = "coulomb_friction = { joint = 'joint', level_nm = 0.5 }";
    let forward = "asymmetric_friction = { joint = 'joint', forward_nm = 0.5, backward_nm = 0.1 }";
    let bristles = "presliding_friction = { joint = 'joint', stiffness_nm_per_rad = 1e4, \
        damping_nm_s_per_rad = 20.0, level_nm = 0.5 }";
    for friction in [coulomb, forward, bristles] {
        let effects = warming("", friction);
        let mut wheel = simulator(&flywheel(0.4, 0.1), &effects, STEPPING).unwrap();
        wheel.start_moving(&[0.0], &[3.0]);
        let rows = run(&mut wheel, 3.0, |_| vec![0.0]).unwrap();
        let from = &rows[5];
        for row in &rows[5..] {
            let lost = 0.5 / INERTIA * (left(row.time_s) - left(from.time_s));
            let found = from.qd_true[0] - row.qd_true[0];
            assert!((found - lost).abs() < 2e-4, "{friction} at {} s: {found}", row.time_s);
        }
    }
}
