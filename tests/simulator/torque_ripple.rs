use std::f64::consts::TAU;

use crate::rig::{FINE, acting, crossings, flywheel, period, run, simulator};

const RIPPLE: &str = "[[effect]]\ntorque_ripple = { joint = 'joint', amplitude_nm = 0.3, periods_per_turn = 36, phase_rad = 0.7 }\n";

/// The motor has to give `amplitude sin(periods q + phase)` on top, so it lacks that: whatever the
/// speed, at every angle.
#[test]
fn oracle_ripple_belongs_to_the_angle_and_its_frequency_to_the_speed() {
    for speed in [1.0, 2.5, -2.5] {
        let mut wheel = simulator(&flywheel(19.9, 0.1), RIPPLE, FINE).unwrap();
        wheel.start_moving(&[0.0], &[speed]);
        let rows = run(&mut wheel, 2.0, |_| vec![0.0]).unwrap();
        for ((time_s, torque), row) in acting(&rows, 20.0).into_iter().zip(&rows[1..]) {
            let expected = -0.3 * (36.0 * row.q_true[0] + 0.7).sin();
            assert!((torque - expected).abs() < 1e-5, "{time_s} s: {torque} N m, not {expected}");
        }
        let turns_per_s = speed.abs() / TAU;
        let periods = 1.0 / (period(&crossings(&rows, |r| r.qd_true[0] - speed)) * turns_per_s);
        assert!((periods / 36.0 - 1.0).abs() < 5e-3, "{periods} periods a turn");
    }
}

/// With a soft transmission the ripple follows the motor, not the link.
#[test]
fn oracle_ripple_belongs_to_the_angle_of_the_motor() {
    let (stiffness, rotor) = (50.0, 0.1);
    let elastic = format!(
        "[[effect]]\njoint_elasticity = {{ joint = 'joint', stiffness_nm_per_rad = {stiffness}, damping_nm_s_per_rad = 0.0 }}\n"
    );
    let mut wheel = simulator(&flywheel(0.4, rotor), &(elastic + RIPPLE), FINE).unwrap();
    wheel.start_moving(&[0.0], &[0.5]);
    let rows = run(&mut wheel, 1.0, |_| vec![0.0]).unwrap();
    let twist = |q: &crate::rig::Row| q.motor_q_true[0] - q.q_true[0];
    assert!(rows.iter().map(|r| twist(r).abs()).fold(0.0, f64::max) > 1e-3);
    for ((_, torque), row) in acting(&rows, rotor).into_iter().zip(&rows[1..]) {
        let ripple = 0.3 * (36.0 * row.motor_q_true[0] + 0.7).sin();
        let expected = -ripple - stiffness * twist(row);
        assert!((torque - expected).abs() < 1e-6, "{torque} N m, not {expected}");
    }
}
