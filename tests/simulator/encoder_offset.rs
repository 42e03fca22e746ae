use crate::rig::{GRAVITY, STEPPING, flywheel, pendulum, run, simulator};

const EFFECT: &str = "[[effect]]\nencoder_offset = { joint = 'joint', offset_rad = 0.05 }";

/// A held pendulum shows the gravity torque of the pose beside the one that is reported.
#[test]
fn oracle_the_log_shows_the_gravity_torque_of_the_neighbouring_pose() {
    let (mass, distance) = (2.0, 0.5);
    for q in [-1.0, 0.3, 1.2] {
        let mut arm = simulator(&pendulum(mass, distance), EFFECT, STEPPING).unwrap();
        arm.start(&[q]);
        let gravity = |q: f64| -mass * GRAVITY * distance * q.cos();
        let rows = run(&mut arm, 0.2, |_| vec![gravity(q)]).unwrap();
        let last = rows.last().unwrap();
        assert!((last.q_true[0] - q).abs() < 1e-9);
        assert!((last.logged.q[0] - (q + 0.05)).abs() < 1e-9, "{}", last.logged.q[0]);
        assert!((last.logged.effort[0] - gravity(last.logged.q[0] - 0.05)).abs() < 1e-7);
    }
}

/// The controller brings to its reference what it sees.
#[test]
fn oracle_a_controller_stops_short_by_the_offset() {
    let mut wheel = simulator(&flywheel(0.4, 0.1), EFFECT, STEPPING).unwrap();
    wheel.start(&[0.0]);
    let rows = run(&mut wheel, 4.0, |r| vec![50.0 * (0.5 - r.q[0]) - 10.0 * r.qd[0]]).unwrap();
    let last = rows.last().unwrap();
    assert!((last.q_true[0] - 0.45).abs() < 1e-6, "{}", last.q_true[0]);
    assert!((last.logged.q[0] - 0.5).abs() < 1e-6);
}
