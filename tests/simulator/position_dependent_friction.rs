use crate::rig::{STEPPING, flywheel, run, simulator};

const FRICTION: &str = "[[effect]]\n\
    position_dependent_friction = { joint = 'joint', level_nm = 0.5, share = 0.4, \
    periods_per_turn = 3.0, phase_rad = 0.7 }";

/// The energy lost on the way from 0 to `q` is the integral of the level:
/// `level (q + share / periods (sin(periods q + phase) - sin(phase)))`, one way and back.
#[test]
fn oracle_the_energy_lost_follows_the_level_along_the_way() {
    for direction in [1.0, -1.0] {
        let mut wheel = simulator(&flywheel(0.4, 0.1), FRICTION, STEPPING).unwrap();
        wheel.start_moving(&[0.0], &[4.0 * direction]);
        let rows = run(&mut wheel, 3.0, |_| vec![0.0]).unwrap();
        assert!(rows.last().unwrap().q_true[0].abs() > 5.0);
        for row in rows.iter().filter(|r| r.time_s < 2.5) {
            let (q, qd) = (row.q_true[0], row.qd_true[0]);
            let lost = 0.25 * (16.0 - qd * qd);
            let wave = 0.4 / 3.0 * ((3.0 * q + 0.7).sin() - 0.7_f64.sin());
            let expected = 0.5 * direction * (q + wave);
            assert!((lost - expected).abs() < 2e-4, "at {q} rad: {lost} J, not {expected} J");
        }
    }
}

#[test]
fn oracle_the_wheel_breaks_away_at_the_level_of_its_place() {
    for q in [0.0, 0.8] {
        let level = 0.5 * (1.0 + 0.4 * (3.0_f64 * q + 0.7).cos());
        let mut wheel = simulator(&flywheel(0.4, 0.1), FRICTION, STEPPING).unwrap();
        wheel.start(&[q]);
        let rows = run(&mut wheel, 2.0, |r| vec![0.5 * r.time_s]).unwrap();
        let held = rows.iter().filter(|r| r.time_s < 2.0 * level);
        assert!(held.map(|r| (r.q_true[0] - q).abs()).fold(0.0, f64::max) < 1e-9);
        let moving = rows.iter().find(|r| r.qd_true[0] > 1e-5).unwrap();
        assert!((moving.time_s - 2.0 * level).abs() < 0.011, "{}", moving.time_s);
    }
}
