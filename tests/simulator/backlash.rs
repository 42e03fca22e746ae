use crate::rig::{FINE, Row, flywheel, run, simulator};

const INERTIA: f64 = 0.4;
const ROTOR: f64 = 0.1;
const GAP: f64 = 0.01;

fn backlash() -> String {
    format!("[[effect]]\nbacklash = {{ joint = 'joint', gap_rad = {GAP} }}")
}

fn twist(row: &Row) -> f64 {
    row.motor_q_true[0] - row.q_true[0]
}

/// Alone the motor crosses half a gap in `t1 = sqrt(gap J / tau)`; the impact is plastic, so
/// that motor and link then turn with all of the momentum: `qd = tau t / (I + J)`.
#[test]
fn oracle_the_motor_crosses_half_the_gap_alone_and_shares_its_momentum_on_impact() {
    let mut wheel = simulator(&flywheel(INERTIA, ROTOR), &backlash(), FINE).unwrap();
    wheel.start(&[0.0]);
    let tau = 0.5;
    let rows = run(&mut wheel, 0.1, |_| vec![tau]).unwrap();
    let impact = (GAP * ROTOR / tau).sqrt();
    for row in &rows {
        let t = row.time_s;
        if t < impact {
            assert!(row.qd_true[0].abs() < 1e-9, "the link moves at {t} s");
            let free = 0.5 * tau / ROTOR * t * t;
            assert!((row.motor_q_true[0] - free).abs() < 1e-9, "the motor at {t} s");
        } else if t > impact + 5e-4 {
            let shared = tau * t / (INERTIA + ROTOR);
            assert!((row.qd_true[0] - shared).abs() < 1e-6, "{} at {t} s", row.qd_true[0]);
            // The stop is felt a step late: speed of the motor times a step.
            assert!((twist(row) - 0.5 * GAP).abs() < 3e-5, "{} at {t} s", twist(row));
        }
    }
}

/// Torque to and fro: where the link is not accelerated the twist covers the gap, where it is
/// the motor leans on one end or the other.
#[test]
fn oracle_the_dead_zone_has_the_width_of_the_gap_both_ways() {
    let mut wheel = simulator(&flywheel(INERTIA, ROTOR), &backlash(), FINE).unwrap();
    wheel.start(&[0.0]);
    let command = |t: f64| 2.0 * (std::f64::consts::TAU * t).cos();
    let rows = run(&mut wheel, 3.0, |r| vec![command(r.time_s)]).unwrap();
    let (mut free, mut driven) = ([0.0_f64; 2], [0; 2]);
    for pair in rows.windows(2) {
        let acceleration = (pair[1].qd_true[0] - pair[0].qd_true[0]) / FINE.step_s;
        let at = twist(&pair[0]);
        if acceleration.abs() < 1e-9 {
            free = [free[0].min(at), free[1].max(at)];
        } else if (acceleration - command(pair[0].time_s) / (INERTIA + ROTOR)).abs() < 0.01 {
            assert!((at.abs() - 0.5 * GAP).abs() < 5e-5, "driven at a twist of {at}");
            driven[usize::from(acceleration > 0.0)] += 1;
        }
    }
    assert!((free[1] - free[0] - GAP).abs() < 0.01 * GAP, "{free:?}");
    assert!(driven.iter().all(|&steps| steps > 8000), "{driven:?}");
}
