use std::f64::consts::PI;

use checks::arms::{base_from_links, potential_energy, wam};
use nalgebra::{Isometry3, Matrix3, Point3, Unit, Vector3};
use robot::{Actuator, Inertia, JointKind, Machine, Robot};

use crate::rig::{FINE, GRAVITY, flywheel, link, simulator};

/// Accelerations (rad/s²) over one step from rest.
fn acceleration(robot: &Robot, effects: &str, q: &[f64], tau: &[f64]) -> Vec<f64> {
    let mut arm = simulator(robot, effects, FINE).unwrap();
    arm.start(q);
    arm.actuate(tau).unwrap();
    arm.qd_true().iter().map(|qd| qd / FINE.step_s).collect()
}

/// Two joints about y, the second 0.6 m out along x.
fn two_joints() -> Robot {
    let body = |mass: f64, x: f64| Inertia {
        mass,
        com_in_link: Vector3::new(x, 0.0, 0.0),
        about_com: Matrix3::identity() * 0.01,
    };
    let hinge = |name: &str, parent, inertia| {
        link(name, parent, JointKind::Continuous, inertia, Actuator::default())
    };
    let upper = hinge("shoulder", None, body(3.0, 0.3));
    let mut lower = hinge("elbow", Some(0), body(2.0, 0.25));
    lower.joint.parent_from_joint = Isometry3::translation(0.6, 0.0, 0.0);
    Robot::new("two", Vector3::new(0.0, 0.0, -GRAVITY), vec![upper, lower]).unwrap()
}

/// A point at (x, z) of a link turned by `a` about y lies `z cos(a) - x sin(a)` high, so a mass
/// there needs `m g (-x cos(a) - z sin(a))`.
#[test]
fn oracle_an_arm_of_two_joints_holds_its_payload_with_the_torque_of_its_weight() {
    let effects =
        "[[effect]]\npayload = { link = 'elbow_link', mass_kg = 1.5, com_m = [0.2, 0.05, 0.1] }";
    let (q1, q2) = (0.4_f64, -1.1_f64);
    let hold = |mass: f64, x: f64, z: f64, a: f64| mass * GRAVITY * (-x * a.cos() - z * a.sin());
    let elbow = hold(2.0, 0.25, 0.0, q1 + q2) + hold(1.5, 0.2, 0.1, q1 + q2);
    let shoulder = hold(3.0, 0.3, 0.0, q1) + hold(2.0 + 1.5, 0.6, 0.0, q1) + elbow;
    let a = acceleration(&two_joints(), effects, &[q1, q2], &[shoulder, elbow]);
    assert!(a.iter().all(|a| a.abs() < 1e-8), "{a:?} rad/s²");
}

/// `J^T m g` as the slope of the payload's height, by differences along the robot's kinematics.
#[test]
fn oracle_the_wam_holds_its_payload_with_the_torque_of_its_weight() {
    let robot = wam();
    let last = robot.links().last().unwrap().name.clone();
    let (mass, com) = (2.5, Point3::new(0.03, -0.02, 0.12));
    let effects = format!(
        "[[effect]]\npayload = {{ link = '{last}', mass_kg = {mass}, com_m = [0.03, -0.02, 0.12] }}"
    );
    let q = [0.3, 1.2, -0.4, 1.0, 0.2, 0.5, 0.1];
    let energy = |q: &[f64]| {
        let height = (base_from_links(&robot, q)[6] * com).coords;
        potential_energy(&robot, q) - mass * robot.gravity_in_base().dot(&height)
    };
    let step = 1e-5;
    let slope = |i: usize| {
        let shifted = |by: f64| {
            let mut q = q;
            q[i] += by;
            energy(&q)
        };
        (shifted(step) - shifted(-step)) / (2.0 * step)
    };
    let tau: Vec<f64> = (0..7).map(slope).collect();
    let a = acceleration(&robot, &effects, &q, &tau);
    // Differences leave about 1e-9 N m, which the wrist's 0.003 kg m² turn into 1e-6 rad/s².
    assert!(a.iter().all(|a| a.abs() < 1e-5), "{a:?} rad/s²");
}

/// A ball of steel, `2/5 m r²` with `m = 4/3 pi r³ 7850 kg/m³`, or what is stated.
#[test]
fn oracle_a_payload_adds_its_inertia_about_the_joint() {
    let (mass, lever) = (2.0_f64, 0.3);
    let radius = (3.0 * mass / (4.0 * PI * 7850.0)).cbrt();
    let cases =
        [("", 0.4 * mass * radius * radius), (", inertia_kg_m2 = [1, 1.2, 0.9, 0, 0, 0]", 0.9)];
    for (stated, own) in cases {
        let effects = format!(
            "[[effect]]\npayload = {{ link = 'joint_link', mass_kg = {mass}, com_m = [0.0, {lever}, 0.7]{stated} }}"
        );
        let a = acceleration(&flywheel(0.4, 0.1), &effects, &[0.0], &[1.0])[0];
        let inertia = 0.5 + mass * lever * lever + own;
        assert!((a * inertia - 1.0).abs() < 1e-9, "{} kg m², not {inertia}", 1.0 / a);
    }
}

/// About the axis halfway between x and y: `(xx + yy) / 2 + xy`, and so on.
#[test]
fn oracle_a_stated_inertia_is_read_as_xx_yy_zz_xy_xz_yz() {
    let effects = "[[effect]]\npayload = { link = 'joint_link', mass_kg = 2, com_m = [0, 0, 0], inertia_kg_m2 = [1, 1.2, 0.9, 0.1, -0.2, 0.3] }";
    let halfway = [
        (Vector3::new(1.0, 1.0, 0.0), 1.1 + 0.1),
        (Vector3::new(1.0, 0.0, 1.0), 0.95 - 0.2),
        (Vector3::new(0.0, 1.0, 1.0), 1.05 + 0.3),
    ];
    for (axis, own) in halfway {
        let mut wheel = flywheel(0.4, 0.1);
        wheel.link_mut(0).unwrap().joint.axis_in_joint = Unit::new_normalize(axis);
        let a = acceleration(&wheel, effects, &[0.0], &[1.0])[0];
        assert!((a * (0.5 + own) - 1.0).abs() < 1e-9, "{} kg m² about {axis}", 1.0 / a);
    }
}
