use crate::rig::{STEPPING, flywheel, run, simulator};

const LEVELS: [f64; 2] = [0.75, 0.4];
const FRICTION: &str = "[[effect]]\n\
    asymmetric_friction = { joint = 'joint', forward_nm = 0.75, backward_nm = 0.4 }";

/// `I qdd = -level` in either direction: stopped after `I |qd| / level` and `I qd^2 / (2 level)`.
#[test]
fn oracle_a_wheel_stops_under_the_level_of_its_direction() {
    for (direction, level) in [1.0, -1.0].into_iter().zip(LEVELS) {
        let mut wheel = simulator(&flywheel(0.4, 0.1), FRICTION, STEPPING).unwrap();
        wheel.start_moving(&[0.0], &[3.0 * direction]);
        let rows = run(&mut wheel, 4.0, |_| vec![0.0]).unwrap();
        let stopped = rows.iter().find(|r| r.qd_true[0].abs() < 1e-9).unwrap();
        assert!((stopped.time_s - 0.5 * 3.0 / level).abs() <= 2.1e-3, "{}", stopped.time_s);
        let way = direction * rows.last().unwrap().q_true[0];
        assert!((way - 0.5 * 0.5 * 9.0 / level).abs() < 2e-4, "{way}");
    }
}

#[test]
fn oracle_a_wheel_at_rest_breaks_away_at_the_level_of_its_direction() {
    for (direction, level) in [1.0, -1.0].into_iter().zip(LEVELS) {
        let mut wheel = simulator(&flywheel(0.4, 0.1), FRICTION, STEPPING).unwrap();
        wheel.start(&[0.0]);
        let rows = run(&mut wheel, 2.0, |r| vec![direction * 0.5 * r.time_s]).unwrap();
        let held = rows.iter().filter(|r| r.time_s < 2.0 * level);
        assert!(held.map(|r| r.q_true[0].abs()).fold(0.0, f64::max) < 1e-9);
        let moving = rows.iter().find(|r| direction * r.qd_true[0] > 1e-5).unwrap();
        assert!((moving.time_s - 2.0 * level).abs() < 0.011, "{}", moving.time_s);
    }
}
