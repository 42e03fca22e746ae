use crate::rig::{STEPPING, flywheel, run, simulator};

/// `q = ratio q_reported`, `tau = effort / ratio`: what the log shows as power is the power.
#[test]
fn oracle_position_and_effort_are_off_by_the_ratio_and_its_inverse_and_power_is_not() {
    for ratio in [1.04, 0.8] {
        let effect =
            format!("[[effect]]\ntransmission_ratio = {{ joint = 'joint', ratio = {ratio} }}");
        let mut wheel = simulator(&flywheel(0.4, 0.1), &effect, STEPPING).unwrap();
        wheel.start_moving(&[0.3], &[0.5]);
        let rows = run(&mut wheel, 1.0, |_| vec![1.5]).unwrap();
        for row in rows.iter().skip(1) {
            let speed = 0.5 + 1.5 / ratio * row.time_s / 0.5;
            let q = 0.3 + 0.5 * (0.5 + speed) * row.time_s;
            assert!((row.qd_true[0] - speed).abs() < 1e-9, "{} rad/s", row.qd_true[0]);
            assert!((row.logged.qd[0] - speed / ratio).abs() < 1e-9);
            assert!((row.logged.q[0] - q / ratio).abs() < 1e-8, "{} rad", row.logged.q[0]);
            assert!((row.logged.effort[0] - 1.5).abs() < 1e-12);
            let power = row.motor_torque_true[0] * row.qd_true[0];
            assert!((row.logged.effort[0] * row.logged.qd[0] - power).abs() < 1e-9);
        }
    }
}
