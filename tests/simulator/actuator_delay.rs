use std::f64::consts::TAU;

use nalgebra::Complex;

use crate::rig::{FINE, STEPPING, acting, flywheel, phasor, run, simulator};

fn delay(delay_ms: f64) -> String {
    format!("[[effect]]\nactuator_delay = {{ joint = 'joint', delay_ms = {delay_ms} }}")
}

/// `tau / command = exp(-i w delay)`, with a command held for one step later by half of it.
///
/// Half a step off the grid, what lies between samples loses `(w dt)² / 8` of its amplitude.
#[test]
fn oracle_a_sine_keeps_its_amplitude_and_comes_later_by_the_delay() {
    for (delay_ms, frequency_hz) in [(2.0, 10.0), (2.0, 50.0), (3.37, 50.0), (0.05, 50.0)] {
        let mut wheel = simulator(&flywheel(0.4, 0.1), &delay(delay_ms), FINE).unwrap();
        wheel.start(&[0.0]);
        let omega = TAU * frequency_hz;
        let rows = run(&mut wheel, 0.2003, |r| vec![2.0 * (omega * r.time_s).sin()]).unwrap();
        let torque: Vec<_> =
            acting(&rows, 0.5).into_iter().filter(|s| s.0 > 0.1 && s.0 < 0.20005).collect();
        let held = Complex::from_polar((0.5 * omega * 1e-4).cos(), -0.5 * omega * 1e-4);
        let expected =
            Complex::new(0.0, -2.0) * held * Complex::from_polar(1.0, -1e-3 * omega * delay_ms);
        let found = phasor(&torque, frequency_hz);
        let error = (found - expected).norm() / 2.0;
        assert!(error < 1.5e-4, "{delay_ms} ms, {frequency_hz} Hz: {found}, not {expected}");
    }
}

/// What was asked for at the start counts as asked for long before; a jump comes late by the delay,
/// whole steps or not.
#[test]
fn oracle_a_jump_of_the_command_moves_a_wheel_later_by_the_delay() {
    for delay_ms in [0.0, 0.03, 2.0, 7.77, 60.0] {
        let mut wheel = simulator(&flywheel(0.4, 0.1), &delay(delay_ms), STEPPING).unwrap();
        wheel.start(&[0.0]);
        let jump = |r: &robot::Reading| vec![if r.time_s > 0.0999 { 2.0 } else { 0.5 }];
        let rows = run(&mut wheel, 0.5, jump).unwrap();
        for row in rows {
            let late = (row.time_s - 0.1 - 1e-3 * delay_ms).max(0.0);
            let speed = (0.5 * row.time_s + 1.5 * late) / 0.5;
            // At the jump itself the velocity is known to half a step of the change.
            let near = (row.time_s - 0.1 - 1e-3 * delay_ms).abs() < 2e-4;
            let tolerance = if near { 1.5e-4 * 1.5 / 0.5 } else { 1e-9 };
            assert!(
                (row.qd_true[0] - speed).abs() < tolerance,
                "{delay_ms} ms at {} s: {} rad/s, not {speed}",
                row.time_s,
                row.qd_true[0]
            );
        }
    }
}
