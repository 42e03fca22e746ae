use crate::rig::{GRAVITY, STEPPING, pendulum, run, simulator};

/// An effort of `gain` times its gravity torque holds a pendulum, and is what the log shows.
#[test]
fn oracle_a_pendulum_is_held_by_gain_times_its_gravity_torque() {
    let (mass, distance, q, gain) = (2.0, 0.5, 0.3, 1.2);
    let effect = format!("[[effect]]\ntorque_constant = {{ joint = 'joint', gain = {gain} }}");
    let mut arm = simulator(&pendulum(mass, distance), &effect, STEPPING).unwrap();
    arm.start(&[q]);
    let holding = -mass * GRAVITY * distance * f64::cos(q);
    let rows = run(&mut arm, 0.5, |_| vec![gain * holding]).unwrap();
    for row in rows.iter().skip(1) {
        assert!((row.q_true[0] - q).abs() < 1e-9, "{} s: {}", row.time_s, row.q_true[0]);
        assert!((row.motor_torque_true[0] - holding).abs() < 1e-12);
        assert!((row.logged.effort[0] - gain * holding).abs() < 1e-12);
    }
}
