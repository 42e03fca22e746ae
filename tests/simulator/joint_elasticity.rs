use std::f64::consts::{PI, TAU};

use crate::rig::{FINE, GRAVITY, Row, crossings, flywheel, pendulum, period, run, simulator};

const INERTIA: f64 = 0.4;
const ROTOR: f64 = 0.1;
const STIFFNESS: f64 = 2000.0;
const DAMPING: f64 = 2.0;

fn elastic(stiffness: f64, damping: f64) -> String {
    format!(
        "[[effect]]\njoint_elasticity = {{ joint = 'joint', stiffness_nm_per_rad = {stiffness}, damping_nm_s_per_rad = {damping} }}\n"
    )
}

/// Friction that no torque of these tests overcomes.
const LOCK: &str = "[[effect]]\ncoulomb_friction = { joint = 'joint', level_nm = 1000.0 }\n";

/// Frequency (rad/s) and share of critical damping of a decaying oscillation about zero.
fn oscillation(rows: &[Row], value: impl Fn(&Row) -> f64) -> (f64, f64) {
    let times = crossings(rows, &value);
    let peak = |w: &[f64]| {
        let within = rows.iter().filter(|r| r.time_s > w[0] && r.time_s < w[1]);
        within.map(&value).fold(0.0, f64::max)
    };
    let peaks: Vec<f64> = times.windows(2).map(peak).collect();
    let decay = (peaks[0] / peaks[peaks.len() - 1]).ln() / (peaks.len() - 1) as f64;
    let damped = TAU / period(&times);
    let ratio = decay / (4.0 * PI * PI + decay * decay).sqrt();
    (damped / (1.0 - ratio * ratio).sqrt(), ratio)
}

fn assert_close(found: (f64, f64), inverse_inertia: f64) {
    let omega = (STIFFNESS * inverse_inertia).sqrt();
    let ratio = 0.5 * DAMPING * (inverse_inertia / STIFFNESS).sqrt();
    // The engine takes damping implicitly, which makes things slower by d dt / 4 (1/I + 1/J).
    assert!((found.0 / omega - 1.0).abs() < 1e-3, "{} rad/s, not {omega}", found.0);
    assert!((found.1 / ratio - 1.0).abs() < 5e-3, "{} of critical, not {ratio}", found.1);
}

/// With the motor held the link swings at the antiresonance, `sqrt(k / I)`.
#[test]
fn oracle_the_link_of_a_held_motor_swings_at_the_antiresonance_and_decays() {
    let effects = elastic(STIFFNESS, DAMPING) + LOCK;
    let mut wheel = simulator(&flywheel(INERTIA, ROTOR), &effects, FINE).unwrap();
    wheel.start_moving(&[0.0], &[0.2]);
    let rows = run(&mut wheel, 0.8, |_| vec![0.0]).unwrap();
    assert!(rows.iter().all(|r| r.motor_q_true[0].abs() < 1e-7), "the motor is not held");
    assert_close(oscillation(&rows, |r| r.q_true[0]), 1.0 / INERTIA);
}

/// Both free, they swing against each other at the resonance, `sqrt(k (1/I + 1/J))`, and the
/// impulse of the motor is their momentum.
#[test]
fn oracle_free_motor_and_link_swing_at_the_resonance_and_keep_their_momentum() {
    let effects = elastic(STIFFNESS, DAMPING);
    let mut wheel = simulator(&flywheel(INERTIA, ROTOR), &effects, FINE).unwrap();
    wheel.start(&[0.0]);
    let pulse = |t: f64| if t < 0.01 { 3.0 } else { 0.0 };
    let rows = run(&mut wheel, 1.0, |r| vec![pulse(r.time_s + 1e-9)]).unwrap();
    let swing: Vec<Row> =
        rows.iter().filter(|r| r.time_s > 0.012 && r.time_s < 0.4).cloned().collect();
    let twist = |r: &Row| r.motor_q_true[0] - r.q_true[0];
    assert_close(oscillation(&swing, twist), 1.0 / INERTIA + 1.0 / ROTOR);
    let speed = rows[rows.len() - 1].qd_true[0];
    let shared = 3.0 * 0.01 / (INERTIA + ROTOR);
    assert!((speed - shared).abs() < 1e-4 * shared, "{speed} rad/s, not {shared}");
}

/// Held against gravity, the link sags by `tau / k`, and by half the gap more with backlash.
#[test]
fn oracle_a_load_twists_the_transmission_by_half_the_gap_and_by_its_torque_over_stiffness() {
    let (mass, distance, stiffness, gap) = (2.0, 0.5, 500.0, 0.004);
    let rotor = "[[effect]]\nrotor_inertia = { joint = 'joint', inertia_kg_m2 = 0.1 }\n";
    let backlash = format!("[[effect]]\nbacklash = {{ joint = 'joint', gap_rad = {gap} }}\n");
    for (more, play) in [("", 0.0), (backlash.as_str(), 0.5 * gap)] {
        let effects = elastic(stiffness, 5.0) + LOCK + rotor + more;
        let mut arm = simulator(&pendulum(mass, distance), &effects, FINE).unwrap();
        arm.start(&[0.0]);
        let rows = run(&mut arm, 4.0, |_| vec![0.0]).unwrap();
        let last = rows.last().unwrap();
        // A positive turn lowers the load.
        let q = last.q_true[0];
        let sag = play + mass * GRAVITY * distance * q.cos() / stiffness;
        assert!(last.motor_q_true[0].abs() < 1e-7);
        assert!((q - last.motor_q_true[0] - sag).abs() < 1e-7, "{q}, not {sag}");
    }
}
