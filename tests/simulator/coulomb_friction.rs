use crate::rig::{STEPPING, flywheel, run, simulator};

fn friction(level: f64) -> String {
    format!("[[effect]]\ncoulomb_friction = {{ joint = 'joint', level_nm = {level} }}")
}

/// `I qdd = -level`: from 3 rad/s it rests after `I qd / level` and has turned `I qd² / (2 level)`.
#[test]
fn oracle_a_spinning_wheel_stops_where_friction_work_has_used_its_energy() {
    let mut wheel = simulator(&flywheel(0.4, 0.1), &friction(0.75), STEPPING).unwrap();
    wheel.start_moving(&[0.0], &[3.0]);
    let rows = run(&mut wheel, 2.5, |_| vec![0.0]).unwrap();
    let stopped = rows.iter().find(|r| r.qd_true[0].abs() < 1e-9).unwrap();
    assert!((stopped.time_s - 0.5 * 3.0 / 0.75).abs() <= 2.1e-3, "{}", stopped.time_s);
    let angle = rows.last().unwrap().q_true[0];
    assert!((angle - 0.5 * 0.5 * 9.0 / 0.75).abs() < 2e-4, "{angle}");
}

/// A torque that ramps at 0.5 N m/s moves the wheel once it exceeds the level, not before.
#[test]
fn oracle_the_wheel_breaks_away_at_the_level_and_does_not_creep_below() {
    let mut wheel = simulator(&flywheel(0.4, 0.1), &friction(0.75), STEPPING).unwrap();
    wheel.start(&[0.0]);
    let rows = run(&mut wheel, 2.0, |r| vec![0.5 * r.time_s]).unwrap();
    let before = rows.iter().filter(|r| r.time_s < 1.5).map(|r| r.q_true[0].abs());
    assert!(before.fold(0.0, f64::max) < 1e-9);
    let moving = rows.iter().find(|r| r.qd_true[0] > 1e-5).unwrap();
    assert!((moving.time_s - 1.5).abs() < 0.011, "{}", moving.time_s);
}
