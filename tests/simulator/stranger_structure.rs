//! Strangers of bearings, base and encoder, against closed forms.

use std::f64::consts::FRAC_PI_4;

use nalgebra::{Matrix3, Unit, Vector3};
use robot::{Actuator, Inertia, JointKind, Reading, Robot};

use crate::rig::{GRAVITY, Row, STEPPING, crossings, flywheel, link, pendulum, period, run};
use crate::strangers::arm;

const MASS: f64 = 2.0;
const DISTANCE: f64 = 0.3;

/// A spindle of 2 kg that turns about its own axis, x, at the end of a level arm of 0.3 m.
fn spindle() -> Robot {
    let bar = Inertia {
        mass: 1e-3,
        com_in_link: Vector3::zeros(),
        about_com: Matrix3::from_diagonal_element(1e-3),
    };
    let body = Inertia {
        mass: MASS,
        com_in_link: Vector3::new(DISTANCE, 0.0, 0.0),
        about_com: Matrix3::from_diagonal_element(0.05),
    };
    let shoulder = link("shoulder", None, JointKind::Continuous, bar, Actuator::default());
    let mut wheel = link("wheel", Some(0), JointKind::Continuous, body, Actuator::default());
    wheel.joint.axis_in_joint = Unit::new_normalize(Vector3::x());
    Robot::new("spindle", Vector3::new(0.0, 0.0, -GRAVITY), vec![shoulder, wheel]).unwrap()
}

/// Torque that holds the first joint at `q` against gravity as it is without strangers.
fn hold(reading: &Reading, q: f64) -> f64 {
    let gravity = -MASS * GRAVITY * DISTANCE * q.cos();
    gravity - 4000.0 * (reading.q[0] - q) - 60.0 * reading.qd[0]
}

/// The shoulder carries `m g l`, so that the spindle is braked by `coefficient m g l`, and by
/// nothing where the arm hangs.
#[test]
fn oracle_a_tilting_bearing_rubs_with_the_load_of_its_neighbour() {
    let stranger = |c: f64| format!("tilting_bearing = {{ joint = 'wheel', coefficient = {c:?} }}");
    let hanging = std::f64::consts::FRAC_PI_2;
    for (coefficient, q) in
        [(0.01, 0.0), (0.02, 0.0), (0.02, FRAC_PI_4), (0.02, hanging), (0.0, 0.0)]
    {
        let mut arm = arm(&spindle(), &stranger(coefficient), STEPPING);
        arm.start_moving(&[q, 0.0], &[0.0, 5.0]);
        let rows = run(&mut arm, 0.6, |r| vec![hold(r, q), 0.0]).unwrap();
        let (early, late) = (&rows[50], rows.last().unwrap());
        let braking = (early.qd_true[1] - late.qd_true[1]) / (late.time_s - early.time_s);
        let expected = coefficient * MASS * GRAVITY * DISTANCE * q.cos() / 0.05;
        assert!((braking - expected).abs() < 2e-3, "{braking}, not {expected} at {q}");
    }
}

/// Torque (N m) that holds a pendulum at rest at `q` on a mount.
fn holding(stiffness: f64, q: f64) -> f64 {
    let stranger = format!(
        "soft_mount = {{ stiffness_nm_per_rad = {stiffness:?}, frequency_hz = 5.0, damping_ratio = 0.2 }}"
    );
    let mut arm = arm(&pendulum(MASS, DISTANCE), &stranger, STEPPING);
    arm.start(&[q]);
    let rows = run(&mut arm, 3.0, |r| vec![hold(r, q)]).unwrap();
    let last = rows.last().unwrap();
    assert!((last.qd_true[0]).abs() < 1e-6, "{last:?}");
    last.motor_torque_true[0]
}

/// The base tilts by `phi = m g l cos(q) / stiffness`, as the joint turns, so that it is held by
/// `-m g l cos(q + phi)`.
#[test]
fn oracle_a_soft_mount_tilts_under_the_weight() {
    let weight = MASS * GRAVITY * DISTANCE;
    for q in [0.0, FRAC_PI_4, -FRAC_PI_4, 2.0] {
        for stiffness in [100.0, 30.0, 1e9] {
            // The controller lets the joint give way by a few mrad.
            let phi = weight * f64::cos(q) / stiffness;
            let given = (holding(stiffness, q) + weight * f64::cos(q)) / 4000.0;
            let expected = -weight * f64::cos(q - given + phi);
            let found = holding(stiffness, q);
            assert!((found - expected).abs() < 2e-3 * weight, "{found}, not {expected} at {q}");
        }
    }
    assert!((holding(100.0, FRAC_PI_4) - holding(1e9, FRAC_PI_4)).abs() > 0.02 * weight);
}

/// After a move the base rocks with its frequency and is felt in the torque that holds the arm.
#[test]
fn oracle_a_soft_mount_rocks_with_its_frequency() {
    let (frequency, damping) = (4.0, 0.02);
    let stranger = format!(
        "soft_mount = {{ stiffness_nm_per_rad = 200.0, frequency_hz = {frequency:?}, damping_ratio = {damping} }}"
    );
    let mut arm = arm(&pendulum(MASS, DISTANCE), &stranger, STEPPING);
    arm.start(&[0.2]);
    let rows =
        run(&mut arm, 3.0, |r| vec![hold(r, if r.time_s < 0.1 { 0.2 } else { 0.9 })]).unwrap();
    let rest = rows.last().unwrap().motor_torque_true[0];
    let ringing: Vec<Row> = rows.into_iter().filter(|r| (0.6..2.0).contains(&r.time_s)).collect();
    let found = 1.0 / period(&crossings(&ringing, |r| r.motor_torque_true[0] - rest));
    let expected = frequency * f64::sqrt(1.0 - damping * damping);
    assert!((found / expected - 1.0).abs() < 0.02, "{found} Hz, not {expected} Hz");
}

/// The reading, and what the controller sees; the arm itself does not change.
#[test]
fn oracle_an_eccentric_encoder_errs_by_a_sine_of_the_angle() {
    for (eccentricity, phase) in [(0.03, 0.7), (0.0, 0.7)] {
        let stranger = format!(
            "eccentric_encoder = {{ joint = 'joint', eccentricity_rad = {eccentricity:?}, phase_rad = {phase} }}"
        );
        let mut wheel = arm(&flywheel(0.4, 0.1), &stranger, STEPPING);
        wheel.start_moving(&[0.0], &[2.0]);
        for row in run(&mut wheel, 4.0, |_| vec![0.0]).unwrap() {
            let (sin, cos) = f64::sin_cos(row.q_true[0] + phase);
            let (q, qd) = (row.q_true[0] + eccentricity * sin, 2.0 * (1.0 + eccentricity * cos));
            assert!((row.logged.q[0] - q).abs() < 1e-12 && (row.logged.qd[0] - qd).abs() < 1e-9);
            assert!((row.qd_true[0] - 2.0).abs() < 1e-9);
        }
    }
}
