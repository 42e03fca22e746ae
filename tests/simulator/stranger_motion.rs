//! Strangers that act on the motion of one joint, against closed forms and energy.

use std::f64::consts::{E, PI, TAU};

use nalgebra::{Matrix3, Unit, Vector3};
use robot::{Actuator, Inertia, JointKind, Robot};

use crate::rig::{FINE, GRAVITY, Row, STEPPING, flywheel, link, run};
use crate::strangers::arm;

/// Of the wheel with its rotor (kg m²).
const INERTIA: f64 = 0.5;

/// A wheel that is let go at a position with a velocity, under a constant torque.
fn thrown(stranger: &str, from: (f64, f64), torque: f64, duration_s: f64) -> Vec<Row> {
    let mut wheel = arm(&flywheel(0.4, 0.1), stranger, STEPPING);
    wheel.start_moving(&[from.0], &[from.1]);
    run(&mut wheel, duration_s, |_| vec![torque]).unwrap()
}

fn last(rows: &[Row]) -> (f64, f64) {
    let row = rows.last().unwrap();
    (row.q_true[0], row.qd_true[0])
}

/// Touched at speed `v`, the wheel goes `v sqrt(I / k)` deep, stays `pi sqrt(I / k)` and leaves as
/// it came; with damping slower, never pulled back.
#[test]
fn oracle_a_soft_wall_gives_back_the_energy_that_it_takes() {
    let (speed, stiffness) = (2.0, 80.0);
    let wall = |side: &str, at: f64, damping: f64| {
        format!(
            "soft_wall = {{ joint = 'joint', wall_rad = {at}, side = '{side}', stiffness_nm_per_rad = {stiffness:?}, damping_nm_s_per_rad = {damping:?} }}"
        )
    };
    let depth = speed * f64::sqrt(INERTIA / stiffness);
    for (side, sign) in [("above", 1.0), ("below", -1.0)] {
        let rows = thrown(&wall(side, 0.5 * sign, 0.0), (0.0, sign * speed), 0.0, 1.0);
        let deepest = rows.iter().map(|r| sign * r.q_true[0]).fold(0.0, f64::max);
        assert!((deepest - 0.5 - depth).abs() < 1e-5, "{deepest}, not 0.5 + {depth}");
        let touching = rows.iter().filter(|r| sign * r.q_true[0] > 0.5).count() as f64 * 2e-3;
        assert!((touching - PI * f64::sqrt(INERTIA / stiffness)).abs() < 2.5e-3, "{touching} s");
        assert!((last(&rows).1 + sign * speed).abs() < 2e-3, "{:?}", last(&rows));
        // The other side is free.
        let free = thrown(&wall(side, 0.5 * sign, 0.0), (0.0, -sign * speed), 0.0, 1.0);
        assert!((last(&free).1 + sign * speed).abs() < 1e-9, "{:?}", last(&free));
    }
    let damped = thrown(&wall("above", 0.5, 8.0), (0.0, speed), 0.0, 2.0);
    assert!(damped.windows(2).all(|w| w[1].qd_true[0] <= w[0].qd_true[0] + 1e-12));
    let back = -last(&damped).1 / speed;
    assert!((0.1..0.7).contains(&back), "{back}");
}

/// `I qd² / 2 + U(q)` stays, and it is `peak width sqrt(e)` less deep inside than far away.
#[test]
fn oracle_a_magnet_well_takes_no_energy_and_its_depth_is_that_of_its_potential() {
    let (centre, width, peak) = (1.0, 0.2, 1.5);
    let well = format!(
        "magnet_well = {{ joint = 'joint', centre_rad = {centre:?}, width_rad = {width}, peak_nm = {peak} }}"
    );
    let depth = peak * width * E.sqrt();
    let rows = thrown(&well, (-1.0, 1.2), 0.0, 2.5);
    let kinetic = |r: &Row| 0.5 * INERTIA * r.qd_true[0].powi(2);
    let start = kinetic(&rows[0]);
    for row in &rows {
        let x = (row.q_true[0] - centre) / width;
        let potential = -depth * (-0.5 * x * x).exp();
        assert!((kinetic(row) + potential - start).abs() < 1e-3 * depth, "{row:?}");
    }
    let fastest = rows.iter().map(kinetic).fold(0.0, f64::max);
    assert!((fastest - start - depth).abs() < 2e-3 * depth, "{fastest}");
    assert!(last(&rows).0 > 2.0 && (kinetic(rows.last().unwrap()) - start).abs() < 1e-4);
    // The largest torque is at the width.
    let mut wheel = arm(&flywheel(0.4, 0.1), &well, FINE);
    wheel.start(&[centre + width]);
    let pulled = run(&mut wheel, 2e-3, |_| vec![0.0]).unwrap();
    let qdd = last(&pulled).1 / pulled.last().unwrap().time_s;
    assert!((qdd * INERTIA + peak).abs() < 1e-3, "{}", qdd * INERTIA);
    let weak = thrown(&well.replace("1.5", "0.0"), (-1.0, 1.2), 0.0, 2.5);
    assert!((last(&weak).1 - 1.2).abs() < 1e-9);
}

/// `qd = v / (1 + c v t / I)`.
#[test]
fn oracle_square_drag_slows_a_wheel_with_the_inverse_of_time() {
    let drag =
        |c: f64| format!("square_drag = {{ joint = 'joint', coefficient_nm_s2_per_rad2 = {c:?} }}");
    for v in [3.0, -3.0] {
        for row in thrown(&drag(0.4), (0.0, v), 0.0, 4.0) {
            let expected = v / (1.0 + 0.4 * v.abs() * row.time_s / INERTIA);
            assert!((row.qd_true[0] - expected).abs() < 1e-3, "{} not {expected}", row.qd_true[0]);
        }
        let free = thrown(&drag(0.0), (0.0, v), 0.0, 4.0);
        assert!((last(&free).1 - v).abs() < 1e-9);
    }
}

/// A pass takes `peak width sqrt(2 pi)`; at rest in it, it holds up to its level there.
#[test]
fn oracle_a_snag_takes_the_area_under_its_bump_and_holds_within_it() {
    let (centre, width, peak) = (1.0, 0.05, 3.0);
    let snag = format!(
        "snag = {{ joint = 'joint', centre_rad = {centre:?}, width_rad = {width}, peak_nm = {peak:?} }}"
    );
    let kinetic = |qd: f64| 0.5 * INERTIA * qd * qd;
    for sign in [1.0, -1.0] {
        let rows = thrown(&snag, (centre - sign * 0.6, sign * 2.0), 0.0, 1.0);
        let lost = kinetic(2.0) - kinetic(last(&rows).1);
        let area = peak * width * TAU.sqrt();
        assert!((lost / area - 1.0).abs() < 5e-3, "{lost}, not {area}");
    }
    let level = peak * (-0.5_f64).exp();
    for (torque, moves) in [(0.95 * level, false), (1.05 * level, true)] {
        let (q, _) = last(&thrown(&snag, (centre + width, 0.0), torque, 0.5));
        assert_eq!((q - centre - width).abs() > 1e-6, moves, "{torque}: {q}");
    }
    let far = thrown(&snag, (centre + 10.0 * width, 0.0), 1e-3, 0.5);
    assert!((last(&far).1 - 1e-3 / INERTIA * 0.498).abs() < 1e-6, "{:?}", last(&far));
}

/// Two wheels of 0.5 kg m² that stand on the base side by side.
fn two_wheels() -> Robot {
    let inertia = Inertia {
        mass: 1.0,
        com_in_link: Vector3::zeros(),
        about_com: Matrix3::from_diagonal_element(INERTIA),
    };
    let links = ["one", "two"].map(|name| {
        let mut link =
            link(name, None, JointKind::Continuous, inertia.clone(), Actuator::default());
        link.joint.axis_in_joint = Unit::new_normalize(Vector3::z());
        link
    });
    Robot::new("wheels", Vector3::new(0.0, 0.0, -GRAVITY), links.to_vec()).unwrap()
}

/// One wheel turns freely at `v` and brakes the other with `c v`, which gives nothing back.
#[test]
fn oracle_crosstalk_is_a_torque_in_proportion_to_the_other_speed() {
    let (c, v) = (0.3, 2.0);
    for (coefficient, expected) in [(c, -c * v / INERTIA), (-c, c * v / INERTIA), (0.0, 0.0)] {
        let stranger = format!(
            "speed_crosstalk = {{ joint = 'one', other = 'two', coefficient_nm_s_per_rad = {coefficient:?} }}"
        );
        let mut wheels = arm(&two_wheels(), &stranger, STEPPING);
        wheels.start_moving(&[0.0, 0.0], &[0.0, v]);
        let rows = run(&mut wheels, 1.0, |_| vec![0.0, 0.0]).unwrap();
        for row in rows {
            assert!((row.qd_true[0] - expected * row.time_s).abs() < 1e-9, "{row:?}");
            assert!((row.qd_true[1] - v).abs() < 1e-9);
        }
    }
}
