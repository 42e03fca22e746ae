use std::f64::consts::TAU;

use crate::rig::{FINE, Row, crossings, flywheel, period, run, simulator};

const INERTIA: f64 = 0.5;

/// Runs a wheel of 0.5 kg m² on a cable.
fn wheel(cable: &str, q: f64, qd: f64, duration_s: f64) -> Vec<Row> {
    let effects = format!("[[effect]]\ncable_spring = {{ joint = 'joint', {cable} }}");
    let mut wheel = simulator(&flywheel(0.4, 0.1), &effects, FINE).unwrap();
    wheel.start_moving(&[q], &[qd]);
    run(&mut wheel, duration_s, |_| vec![0.0]).unwrap()
}

/// `T = 2 pi sqrt(I / k)` about the rest position.
#[test]
fn oracle_a_wheel_on_a_cable_swings_about_its_rest_with_the_period_of_its_stiffness() {
    let rows = wheel("stiffness_nm_per_rad = 8.0, rest_rad = 0.3", 0.8, 0.0, 8.0);
    let found = period(&crossings(&rows, |r| r.q_true[0] - 0.3));
    let expected = TAU * (INERTIA / 8.0_f64).sqrt();
    assert!((found / expected - 1.0).abs() < 1e-6, "{found} s, not {expected} s");
}

/// `I qd² / 2 + k x² / 2 + c x⁴ / 4` is the same all the way.
#[test]
fn oracle_the_cubic_term_stores_the_energy_of_its_fourth_power() {
    let cable = "stiffness_nm_per_rad = 2.0, rest_rad = -0.2, cubic_nm_per_rad3 = 5.0";
    let rows = wheel(cable, 0.6, 0.0, 4.0);
    let energy = |r: &Row| {
        let x = r.q_true[0] + 0.2;
        0.5 * INERTIA * r.qd_true[0].powi(2) + x * x + 1.25 * x.powi(4)
    };
    let first = 0.64 + 1.25 * 0.8_f64.powi(4);
    for row in &rows {
        assert!((energy(row) / first - 1.0).abs() < 1e-3, "{} J, not {first} J", energy(row));
    }
    let swing = rows.iter().map(|r| 0.5 * INERTIA * r.qd_true[0].powi(2)).fold(0.0, f64::max);
    assert!((swing / first - 1.0).abs() < 1e-3, "{swing} J of {first} J in motion");
}

/// Once round between turning points `2 a` apart, the sliding spring does the work of its loop:
/// a parallelogram, `4 h (a - h / k)`.
#[test]
fn oracle_the_loop_costs_its_area_in_every_cycle_however_slow() {
    let (stiffness, hysteresis) = (8.0, 0.4);
    for frequency in [0.5, 1.0] {
        let effects = format!(
            "[[effect]]\ncable_spring = {{ joint = 'joint', stiffness_nm_per_rad = {stiffness}, rest_rad = 0.1, hysteresis_nm = {hysteresis} }}"
        );
        let mut wheel = simulator(&flywheel(0.4, 0.1), &effects, FINE).unwrap();
        wheel.start(&[0.0]);
        let cycle = (1.0 / (frequency * FINE.step_s)).round() as usize;
        let rows = run(&mut wheel, 6.0 / frequency, |r| {
            let ahead = 0.5 * (TAU * frequency * r.time_s).sin();
            vec![500.0 * (ahead - r.q[0]) - 30.0 * r.qd[0]]
        })
        .unwrap();
        let last = &rows[rows.len() - cycle - 2..];
        let position = |row: &Row| row.q_true[0];
        let high = last.iter().map(position).fold(f64::MIN, f64::max);
        let low = last.iter().map(position).fold(f64::MAX, f64::min);
        // The work of a leapfrog's torque is that over the steps before and after it; a row holds
        // the torque of the step that led to it.
        let work: f64 = last
            .windows(3)
            .map(|w| 0.5 * w[2].motor_torque_true[0] * (w[2].q_true[0] - w[0].q_true[0]))
            .sum();
        let area = 4.0 * hysteresis * (0.5 * (high - low) - hysteresis / stiffness);
        assert!((work / area - 1.0).abs() < 2e-3, "{work} J, not {area} J, at {frequency} Hz");
    }
}

/// A wheel that runs into its cable is thrown back with its own speed after half a period, and
/// is left alone where the cable is slack.
#[test]
fn oracle_a_cable_that_pulls_on_one_side_leaves_the_other_alone() {
    for (pulls, sign) in [("above", 1.0), ("below", -1.0)] {
        let cable =
            format!("stiffness_nm_per_rad = 8.0, rest_rad = {}, pulls = '{pulls}'", sign * 0.2);
        let rows = wheel(&cable, 0.0, sign, 2.0);
        let half_period = 0.5 * TAU * (INERTIA / 8.0_f64).sqrt();
        for row in &rows {
            let (t, q) = (row.time_s, sign * row.q_true[0]);
            let expected = if t < 0.2 {
                t
            } else if t < 0.2 + half_period {
                0.2 + (INERTIA / 8.0_f64).sqrt() * ((t - 0.2) * (8.0 / INERTIA).sqrt()).sin()
            } else {
                0.2 - (t - 0.2 - half_period)
            };
            assert!((q - expected).abs() < 1e-4, "{pulls}: {q}, not {expected}, at {t} s");
        }
    }
}

/// Thrown into the loop of one side, up to `a` with `I v² / 2 = k a² / 2 + h a - h² / (2 k)`, a
/// wheel comes back with `2 h a - 3 h² / k` less: on the way back the cable is slack from
/// `x = h / k` on.
#[test]
fn oracle_a_cable_of_one_side_keeps_the_area_of_its_loop_and_then_lets_go() {
    let (k, h) = (8.0, 0.4);
    let depth = ((h * h + 2.0 * k * (0.5 * INERTIA + h * h / (2.0 * k))).sqrt() - h) / k;
    let lost = 2.0 * h * depth - 3.0 * h * h / k;
    let speed = (1.0 - 2.0 * lost / INERTIA).sqrt();
    for (pulls, sign) in [("above", 1.0), ("below", -1.0)] {
        let cable = format!(
            "stiffness_nm_per_rad = {k}, rest_rad = {}, hysteresis_nm = {h}, pulls = '{pulls}'",
            sign * 0.2
        );
        let rows = wheel(&cable, 0.0, sign, 2.0);
        let deepest = rows.iter().map(|r| sign * r.q_true[0]).fold(0.0, f64::max) - 0.2;
        assert!((deepest - depth).abs() < 1e-4, "{deepest} rad, not {depth} rad");
        let thrown = rows.iter().filter(|r| r.time_s > 1.0 && sign * r.q_true[0] < 0.2 + h / k);
        for row in thrown {
            let back = -sign * row.qd_true[0];
            assert!((back - speed).abs() < 5e-4, "{back} rad/s, not {speed} rad/s");
        }
        assert!(sign * rows.last().unwrap().q_true[0] < 0.0);
    }
}
