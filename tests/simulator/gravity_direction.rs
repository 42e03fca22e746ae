use nalgebra::Vector3;
use robot::{Machine, Robot};

use crate::rig::{FINE, GRAVITY, flywheel, simulator};

/// A wheel about z with its mass of 1 kg at 0.3 m along x: 0.4 + 0.1 + 0.09 kg m².
fn lopsided() -> Robot {
    let mut robot = flywheel(0.4, 0.1);
    robot.link_mut(0).unwrap().inertia.com_in_link = Vector3::new(0.3, 0.0, 0.0);
    robot
}

fn acceleration(x: f64, y: f64, q: f64) -> f64 {
    let effects =
        format!("[[effect]]\ngravity_direction = {{ tilt_x_rad = {x}, tilt_y_rad = {y} }}");
    let mut wheel = simulator(&lopsided(), &effects, FINE).unwrap();
    wheel.start(&[q]);
    wheel.actuate(&[0.0]).unwrap();
    wheel.qd_true()[0] / FINE.step_s
}

/// Turned about x by `a`, gravity points to `+y` with `g sin(a)`; turned about y by `b`, to `-x`
/// with `g sin(b)`. A vertical joint feels it as `m l (g_y cos(q) - g_x sin(q))`.
#[test]
fn oracle_a_tilt_gives_a_vertical_joint_the_torque_of_gravity() {
    let tilt = 0.07_f64;
    let torque = |gx: f64, gy: f64, q: f64| 0.3 * (gy * q.cos() - gx * q.sin());
    let side = GRAVITY * tilt.sin();
    // About the diagonal: by an angle sqrt(2) tilt, with the same share of both.
    let angle = 2.0_f64.sqrt() * tilt;
    let both = GRAVITY * angle.sin() / 2.0_f64.sqrt();
    for q in [0.0, 0.7, 2.0, -1.3] {
        let cases = [
            (tilt, 0.0, torque(0.0, side, q)),
            (0.0, tilt, torque(-side, 0.0, q)),
            (-tilt, 0.0, torque(0.0, -side, q)),
            (tilt, tilt, torque(-both, both, q)),
        ];
        for (x, y, expected) in cases {
            let found = 0.59 * acceleration(x, y, q);
            assert!((found - expected).abs() < 1e-9, "{x} {y} at {q}: {found}, not {expected}");
        }
    }
}
