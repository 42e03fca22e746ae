use crate::rig::{STEPPING, flywheel, run, simulator};

/// A wheel that is asked for nothing turns as under `-offset`; asked for `offset`, it rests.
#[test]
fn oracle_a_wheel_rests_under_an_effort_of_the_offset() {
    for (effort, torque) in [(0.0, -0.2), (0.2, 0.0), (0.7, 0.5)] {
        let effect = "[[effect]]\ntorque_offset = { joint = 'joint', offset_nm = 0.2 }";
        let mut wheel = simulator(&flywheel(0.4, 0.1), effect, STEPPING).unwrap();
        wheel.start(&[0.0]);
        let rows = run(&mut wheel, 1.0, |_| vec![effort]).unwrap();
        let last = rows.last().unwrap();
        let speed = torque * last.time_s / 0.5;
        assert!((last.qd_true[0] - speed).abs() < 1e-9, "{} rad/s, not {speed}", last.qd_true[0]);
        assert!((last.motor_torque_true[0] - torque).abs() < 1e-12);
        assert!((last.logged.effort[0] - effort).abs() < 1e-12);
    }
}
