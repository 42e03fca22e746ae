use crate::rig::{STEPPING, flywheel, run, simulator};

const FRICTION: &str =
    "[[effect]]\nviscous_friction = { joint = 'joint', viscous_nm_s_per_rad = 0.3 }";

/// `I qdd = -c qd`: the speed falls as `exp(-c t / I)`, the way goes to `I qd / c`.
#[test]
fn oracle_a_spinning_wheel_slows_down_exponentially() {
    let mut wheel = simulator(&flywheel(0.4, 0.1), FRICTION, STEPPING).unwrap();
    wheel.start_moving(&[0.0], &[2.0]);
    for row in run(&mut wheel, 4.0, |_| vec![0.0]).unwrap() {
        let left = (-0.3 / 0.5 * row.time_s).exp();
        assert!((row.qd_true[0] - 2.0 * left).abs() < 1e-4, "{} s", row.time_s);
        assert!((row.q_true[0] - 2.0 * 0.5 / 0.3 * (1.0 - left)).abs() < 1e-4, "{} s", row.time_s);
    }
}

/// On a spring `k` the amplitude falls by `exp(-pi c / sqrt(k I - c^2 / 4))` in a period.
#[test]
fn oracle_a_wheel_on_a_spring_has_the_logarithmic_decrement() {
    let mut robot = flywheel(0.4, 0.1);
    robot.link_mut(0).unwrap().actuator.spring_stiffness = 50.0;
    let mut wheel = simulator(&robot, FRICTION, STEPPING).unwrap();
    wheel.start(&[1.0]);
    let rows = run(&mut wheel, 6.3, |_| vec![0.0]).unwrap();
    let largest = rows.iter().filter(|r| r.time_s > 5.8).map(|r| r.q_true[0]).fold(0.0, f64::max);
    // Period `2 pi / sqrt(k / I - (c / 2 I)^2)`, the tenth peak.
    let period = std::f64::consts::TAU / (50.0 / 0.5 - (0.15_f64 / 0.5).powi(2)).sqrt();
    let tenth = (-0.15 / 0.5 * 10.0 * period).exp();
    assert!((largest / tenth - 1.0).abs() < 3e-4, "{largest} of {tenth}");
}
