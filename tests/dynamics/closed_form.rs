//! A double pendulum by hand, from types and again from URDF text.

use dynamics::{Dynamics, DynamicsError, Rotors};
use nalgebra::{Isometry3, Matrix3, Vector3};
use robot::{Inertia, Joint, JointKind, Limits, Robot};

use checks::arms::{GRAVITY, draw, generator, link};

/// Rounding of some ten operations on numbers up to 100.
const ROUNDING: f64 = 1e-12;

/// Lengths (m), masses (kg) and inertias about the centres of mass (kg m²).
const L1: f64 = 0.7;
const C1: f64 = 0.4;
const C2: f64 = 0.25;
const M1: f64 = 2.0;
const M2: f64 = 1.3;
const I1: f64 = 0.09;
const I2: f64 = 0.03;

/// Both arms hang along -z at zero and turn about +y.
const URDF: &str = r#"<robot name="double pendulum">
  <link name="base"/>
  <link name="upper"><inertial><origin xyz="0 0 -0.4"/><mass value="2"/>
    <inertia ixx="0.05" ixy="0" ixz="0" iyy="0.09" iyz="0" izz="0.05"/></inertial></link>
  <link name="lower"><inertial><origin xyz="0 0 -0.25"/><mass value="1.3"/>
    <inertia ixx="0.02" ixy="0" ixz="0" iyy="0.03" iyz="0" izz="0.02"/></inertial></link>
  <joint name="shoulder" type="continuous"><parent link="base"/><child link="upper"/>
    <axis xyz="0 1 0"/></joint>
  <joint name="elbow" type="continuous"><parent link="upper"/><child link="lower"/>
    <origin xyz="0 0 -0.7"/><axis xyz="0 1 0"/></joint>
</robot>"#;

fn pendulum() -> Robot {
    let arm = |name: &str, parent, at: f64, com: f64, mass, [ixx, iyy]: [f64; 2]| {
        let joint = Joint {
            name: format!("{name} joint"),
            kind: JointKind::Continuous,
            parent_from_joint: Isometry3::translation(0.0, 0.0, -at),
            axis_in_joint: Vector3::y_axis(),
            limits: Limits::default(),
        };
        let inertia = Inertia {
            mass,
            com_in_link: Vector3::new(0.0, 0.0, -com),
            about_com: Matrix3::from_diagonal(&Vector3::new(ixx, iyy, ixx)),
        };
        link(name, parent, joint, inertia)
    };
    let links = vec![
        arm("upper", None, 0.0, C1, M1, [0.05, I1]),
        arm("lower", Some(0), L1, C2, M2, [0.02, I2]),
    ];
    Robot::new("double pendulum", GRAVITY, links).unwrap()
}

/// Lagrange's equations of the double pendulum, angles from the downward vertical.
fn by_hand(q: &[f64], qd: &[f64], qdd: &[f64]) -> [f64; 2] {
    let (sin, cos) = q[1].sin_cos();
    let coupling = M2 * L1 * C2;
    let m22 = I2 + M2 * C2 * C2;
    let m12 = m22 + coupling * cos;
    let m11 = I1 + M1 * C1 * C1 + m22 + M2 * L1 * L1 + 2.0 * coupling * cos;
    let g2 = 9.81 * M2 * C2 * (q[0] + q[1]).sin();
    let g1 = 9.81 * (M1 * C1 + M2 * L1) * q[0].sin() + g2;
    [
        m11 * qdd[0] + m12 * qdd[1] - coupling * sin * qd[1] * (2.0 * qd[0] + qd[1]) + g1,
        m12 * qdd[0] + m22 * qdd[1] + coupling * sin * qd[0] * qd[0] + g2,
    ]
}

fn agrees_with_the_closed_form(robot: &Robot) {
    let (dynamics, mut rng) = (Dynamics::new(robot), generator(3));
    for _ in 0..50 {
        let (q, qd, qdd) = (draw(&mut rng, 2, 3.0), draw(&mut rng, 2, 5.0), draw(&mut rng, 2, 9.0));
        let expected = by_hand(&q, &qd, &qdd);
        let tau = dynamics.inverse_dynamics(&q, &qd, &qdd).unwrap();
        let back = dynamics.forward_dynamics(&q, &qd, &expected, Rotors::Excluded).unwrap();
        for i in 0..2 {
            assert!((tau[i] - expected[i]).abs() < ROUNDING * 100.0);
            assert!((back[i] - qdd[i]).abs() < ROUNDING * 1000.0);
        }
    }
}

#[test]
fn inverse_dynamics_agrees_with_the_closed_form_double_pendulum() {
    agrees_with_the_closed_form(&pendulum());
}

#[test]
fn inverse_dynamics_agrees_with_the_closed_form_double_pendulum_through_urdf() {
    agrees_with_the_closed_form(&Robot::from_urdf(URDF).unwrap());
}

#[test]
fn a_vector_of_the_wrong_length_is_refused() {
    let wrong = Dynamics::new(&pendulum()).inverse_dynamics(&[0.0; 2], &[0.0; 3], &[0.0; 2]);
    assert_eq!(wrong, Err(DynamicsError::WrongLength { vector: "qd", expected: 2, got: 3 }));
}

#[test]
fn a_number_that_is_not_finite_is_refused() {
    let wrong = Dynamics::new(&pendulum()).gravity(&[0.0, f64::INFINITY]);
    let expected = DynamicsError::NotFinite { vector: "q", index: 1, value: f64::INFINITY };
    assert_eq!(wrong, Err(expected));
}

#[test]
fn a_robot_without_mass_has_no_forward_dynamics() {
    let mut robot = pendulum();
    robot.link_mut(1).unwrap().inertia = Inertia::zero();
    let error =
        Dynamics::new(&robot).forward_dynamics(&[0.1; 2], &[0.0; 2], &[0.0; 2], Rotors::Excluded);
    assert_eq!(error, Err(DynamicsError::MassMatrixNotPositive { joint: 1, pivot: 0.0 }));
}
