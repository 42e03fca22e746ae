use std::f64::consts::TAU;

use crate::rig::{FINE, crossings, flywheel, period, run, simulator};

const INERTIA: f64 = 0.5;

fn effect(balance: &str) -> String {
    format!("[[effect]]\ncounterbalance = {{ joint = 'joint', {balance} }}")
}

/// Near the position at which it gives nothing a wheel swings with `T = 2 pi sqrt(I / amplitude)`, longer by
/// `1 + a² / 16` for a swing of `a`.
#[test]
fn oracle_a_wheel_swings_about_the_position_without_torque_as_a_pendulum_does() {
    let balance = effect("amplitude_nm = 8.0, phase_rad = 0.3");
    let mut wheel = simulator(&flywheel(0.4, 0.1), &balance, FINE).unwrap();
    wheel.start_moving(&[-0.2], &[0.0]);
    let rows = run(&mut wheel, 8.0, |_| vec![0.0]).unwrap();
    let found = period(&crossings(&rows, |r| r.q_true[0] + 0.3));
    let swing: f64 = 0.1;
    let expected = TAU * (INERTIA / 8.0_f64).sqrt() * (1.0 + swing.powi(2) / 16.0);
    assert!((found / expected - 1.0).abs() < 1e-6, "{found} s, not {expected} s");
}

/// `I qd² / 2 - amplitude cos(q + phase)` is the same all the way round.
#[test]
fn oracle_a_turning_wheel_keeps_its_energy() {
    let (amplitude, phase) = (3.0, -1.0);
    let balance = effect(&format!("amplitude_nm = {amplitude:?}, phase_rad = {phase:?}"));
    let mut wheel = simulator(&flywheel(0.4, 0.1), &balance, FINE).unwrap();
    wheel.start_moving(&[0.0], &[6.0]);
    let rows = run(&mut wheel, 4.0, |_| vec![0.0]).unwrap();
    let energy = |q: f64, qd: f64| 0.5 * INERTIA * qd * qd - amplitude * (q + phase).cos();
    let first = energy(0.0, 6.0);
    assert!(rows.last().unwrap().q_true[0] > TAU);
    for row in &rows {
        let now = energy(row.q_true[0], row.qd_true[0]);
        assert!((now / first - 1.0).abs() < 1e-3, "{now} J, not {first} J");
    }
}
