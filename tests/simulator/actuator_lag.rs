use std::f64::consts::TAU;

use nalgebra::Complex;

use crate::rig::{FINE, STEPPING, acting, flywheel, phasor, run, simulator};

fn lag(time_constant_ms: f64) -> String {
    format!(
        "[[effect]]\nactuator_lag = {{ joint = 'joint', time_constant_ms = {time_constant_ms} }}"
    )
}

/// `tau / command = 1 / (1 + i w T)`, with a command held for one step later by half of it.
#[test]
fn oracle_a_sine_loses_amplitude_and_phase_as_through_a_first_order_low_pass() {
    for (time_constant_ms, frequency_hz) in [(4.0, 10.0), (4.0, 50.0), (0.05, 50.0), (0.0, 50.0)] {
        let mut wheel = simulator(&flywheel(0.4, 0.1), &lag(time_constant_ms), FINE).unwrap();
        wheel.start(&[0.0]);
        let omega = TAU * frequency_hz;
        let rows = run(&mut wheel, 0.3003, |r| vec![2.0 * (omega * r.time_s).sin()]).unwrap();
        // Whole periods, once the start has died away.
        let torque: Vec<_> =
            acting(&rows, 0.5).into_iter().filter(|s| s.0 > 0.2 && s.0 < 0.30005).collect();
        let held = Complex::from_polar((0.5 * omega * 1e-4).cos(), -0.5 * omega * 1e-4);
        let expected =
            Complex::new(0.0, -2.0) * held / Complex::new(1.0, 1e-3 * omega * time_constant_ms);
        let found = phasor(&torque, frequency_hz);
        let error = (found - expected).norm() / 2.0;
        assert!(error < 1e-4, "{time_constant_ms} ms, {frequency_hz} Hz: {found}, not {expected}");
    }
}

/// All of a jump's impulse arrives, late by the time constant on the mean.
#[test]
fn oracle_a_jump_of_the_command_moves_a_wheel_as_if_it_came_later_by_the_time_constant() {
    for time_constant_ms in [0.03, 1.0, 7.77] {
        let mut wheel = simulator(&flywheel(0.4, 0.1), &lag(time_constant_ms), STEPPING).unwrap();
        wheel.start(&[0.0]);
        let jump = |r: &robot::Reading| vec![if r.time_s > 0.0999 { 2.0 } else { 0.5 }];
        let rows = run(&mut wheel, 0.5, jump).unwrap();
        let last = rows.last().unwrap();
        let impulse = 0.5 * last.time_s + 1.5 * (last.time_s - 0.1 - 1e-3 * time_constant_ms);
        let speed = impulse / 0.5;
        assert!((last.qd_true[0] - speed).abs() < 1e-9, "{} rad/s, not {speed}", last.qd_true[0]);
    }
}
