//! Pinocchio's numbers for three arms, 24 states each.

use std::path::Path;

use dynamics::{Dynamics, Rotors};
use nalgebra::{DMatrix, DVector};
use robot::{Inertia, Robot};

use checks::arms::{data, workspace_root};
use checks::golden::{Golden, State, golden};

/// Relative to the largest entry of a vector or matrix: both engines round alike, some
/// hundred operations deep.
const RELATIVE: f64 = 1e-10;

/// Where every entry vanishes, as velocities and accelerations do in some of the states:
/// the rounding of terms of order 10 that cancel (N·m, rad/s²).
const ABSOLUTE: f64 = 1e-11;

/// Kinematics of the URDF; gravity and rotors of the golden file.
fn load(urdf: &Path, golden: &Golden) -> Robot {
    let mut robot = Robot::load(urdf).unwrap().robot.with_gravity(golden.gravity.into());
    assert_eq!(robot.joint_names().collect::<Vec<_>>(), golden.joints);
    for (i, &rotor) in golden.rotor_inertia.iter().enumerate() {
        robot.link_mut(i).unwrap().actuator.rotor_inertia = rotor;
    }
    robot
}

/// The same robot with the inertias of the golden file.
fn with_golden_inertias(mut robot: Robot, golden: &Golden) -> Robot {
    for (i, pi) in golden.inertial_parameters.iter().enumerate() {
        robot.link_mut(i).unwrap().inertia = Inertia::from_parameters(pi);
    }
    robot
}

fn assert_close(what: &str, found: &[f64], expected: &[f64]) {
    let scale = expected.iter().fold(ABSOLUTE / RELATIVE, |scale, e| scale.max(e.abs()));
    assert_eq!(found.len(), expected.len(), "{what}");
    for (i, (f, e)) in found.iter().zip(expected).enumerate() {
        assert!((f - e).abs() <= RELATIVE * scale, "{what}[{i}]: {f} and {e}");
    }
}

fn agrees(robot: &Robot, golden: &Golden) {
    let dynamics = Dynamics::new(robot);
    let n = dynamics.joint_count();
    assert!(golden.states.len() >= 20);
    for State { q, qd, qdd, .. } in &golden.states {
        assert_eq!([q.len(), qd.len(), qdd.len()], [n; 3]);
    }
    for s in &golden.states {
        let (q, qd, qdd) = (&s.q, &s.qd, &s.qdd);
        let mut tau = dynamics.inverse_dynamics(q, qd, qdd).unwrap();
        assert_close("tau", tau.as_slice(), &s.tau_rigid_body);
        let y = dynamics.torque_regressor(q, qd, qdd).unwrap();
        let pi = robot.links().iter().flat_map(|link| link.inertia.parameters());
        let from_regressor = &y * DVector::from_iterator(10 * n, pi);
        assert_close("Y pi", from_regressor.as_slice(), &s.tau_rigid_body);
        assert_close("row sums", y.column_sum().as_slice(), &s.regressor_row_sums);

        dynamics.add_rotor_torque(qdd, tau.as_mut_slice()).unwrap();
        assert_close("tau with rotors", tau.as_slice(), &s.tau_with_rotor);
        let gravity = dynamics.gravity(q).unwrap();
        assert_close("gravity", gravity.as_slice(), &s.gravity);
        let weighed = dynamics.gravity_regressor(q).unwrap() * robot.gravity_in_base();
        assert_close("gravity regressor", weighed.as_slice(), &s.gravity);
        let coriolis = dynamics.coriolis(q, qd).unwrap();
        assert_close("coriolis", coriolis.as_slice(), &s.coriolis);
        let expected = DMatrix::from_fn(n, n, |i, j| s.mass_matrix[i][j]);
        let mass_matrix = dynamics.mass_matrix(q).unwrap();
        assert_close("mass matrix", mass_matrix.as_slice(), expected.as_slice());
        let qdd = dynamics.forward_dynamics(q, qd, &s.tau_rigid_body, Rotors::Excluded).unwrap();
        assert_close("qdd", qdd.as_slice(), &s.qdd_from_tau);
    }
}

#[test]
fn the_wam_agrees_with_pinocchio() {
    let golden = golden("wam7");
    let robot = load(&workspace_root().join("robots/wam7/robot.urdf"), &golden);
    agrees(&robot, &golden);
    agrees(&with_golden_inertias(robot, &golden), &golden);
}

/// Rows of the derivatives of one state.
#[derive(serde::Deserialize)]
struct Derivatives {
    dq: Vec<Vec<f64>>,
    dqd: Vec<Vec<f64>>,
    dqdd: Vec<Vec<f64>>,
}

#[derive(serde::Deserialize)]
struct AllDerivatives {
    states: Vec<Derivatives>,
}

#[test]
fn the_derivatives_of_the_wam_agree_with_pinocchio() {
    let states = golden("wam7").states;
    let path = workspace_root().join("tests/golden/derivatives_wam7.json");
    let expected: AllDerivatives =
        serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap();
    assert!(states.len() == expected.states.len() && states.len() >= 20);
    let urdf = workspace_root().join("robots/wam7/robot.urdf");
    let dynamics = Dynamics::new(&Robot::load(&urdf).unwrap().robot);
    for (State { q, qd, qdd, .. }, expected) in states.iter().zip(&expected.states) {
        let found = dynamics.inverse_dynamics_derivatives(q, qd, qdd).unwrap();
        let pairs = [
            ("dq", found.dq, &expected.dq),
            ("dqd", found.dqd, &expected.dqd),
            ("dqdd", found.dqdd, &expected.dqdd),
        ];
        for (what, found, rows) in pairs {
            assert_close(what, found.transpose().as_slice(), &rows.concat());
        }
    }
}

#[test]
fn the_kinova_gen3_agrees_with_pinocchio() {
    let golden = golden("kinova_gen3");
    let Some(urdf) = data("kinova_gen3/robot.urdf") else { return };
    let robot = load(&urdf, &golden);
    agrees(&robot, &golden);
    agrees(&with_golden_inertias(robot, &golden), &golden);
}

#[test]
fn the_kuka_lwr4_agrees_with_pinocchio() {
    let golden = golden("kuka_lwr4");
    let Some(urdf) = data("kuka_lwr4/robot.urdf") else { return };
    let robot = load(&urdf, &golden);
    agrees(&robot, &golden);
    agrees(&with_golden_inertias(robot, &golden), &golden);
}
