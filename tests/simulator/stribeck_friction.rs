use crate::rig::{STEPPING, effects, flywheel, run, simulator};

const INERTIA: f64 = 0.5;
const FRICTION: &str = "[[effect]]\n\
    stribeck_friction = { joint = 'joint', coulomb_nm = 0.6, breakaway_nm = 1.0, \
    stribeck_velocity_rad_per_s = 0.5 }";

fn level(speed: f64) -> f64 {
    0.6 + 0.4 * (-(speed / 0.5).powi(2)).exp()
}

/// `I qdd = -level(qd)`: from speed `v` to rest takes the integral of `I / level` from 0 to `v`.
#[test]
fn oracle_a_wheel_slows_down_along_the_stribeck_curve() {
    let mut wheel = simulator(&flywheel(INERTIA - 0.1, 0.1), FRICTION, STEPPING).unwrap();
    wheel.start_moving(&[0.0], &[1.5]);
    let time_below = |v: f64| {
        let cells = 2000;
        let middles = (0..cells).map(|i| v * (f64::from(i) + 0.5) / f64::from(cells));
        middles.map(|speed| INERTIA / level(speed)).sum::<f64>() * v / f64::from(cells)
    };
    let rows = run(&mut wheel, 1.2, |_| vec![0.0]).unwrap();
    let moving: Vec<_> = rows.iter().filter(|r| r.qd_true[0] > 1e-3).collect();
    assert!(moving.len() > 400);
    for row in moving {
        let expected = time_below(1.5) - time_below(row.qd_true[0]);
        assert!((row.time_s - expected).abs() < 1e-4, "{} s, not {expected}", row.time_s);
    }
}

/// Held by up to `breakaway`, again after it has moved and come to rest.
#[test]
fn oracle_the_wheel_breaks_away_at_the_higher_level_each_time() {
    let mut wheel = simulator(&flywheel(INERTIA - 0.1, 0.1), FRICTION, STEPPING).unwrap();
    wheel.start(&[0.0]);
    // Two ramps of 0.5 N m/s, the torque gone for half a second after each.
    let rows = run(&mut wheel, 5.5, |r| {
        let since = r.time_s % 2.75;
        vec![if since < 2.25 { 0.5 * since } else { 0.0 }]
    })
    .unwrap();
    for start_s in [0.0, 2.75] {
        let from = rows.iter().find(|r| r.time_s >= start_s).unwrap().q_true[0];
        let ramp: Vec<_> = rows.iter().filter(|r| r.time_s >= start_s).collect();
        let held = ramp.iter().filter(|r| r.time_s < start_s + 2.0);
        assert!(held.map(|r| (r.q_true[0] - from).abs()).fold(0.0, f64::max) < 1e-9);
        let moving = ramp.iter().find(|r| r.qd_true[0] > 1e-5).unwrap();
        assert!((moving.time_s - start_s - 2.0).abs() < 0.011, "{}", moving.time_s);
    }
}

#[test]
fn a_breakaway_below_the_coulomb_level_is_refused() {
    let effect = FRICTION.replace("breakaway_nm = 1.0", "breakaway_nm = 0.5");
    let mistake = effects(&effect)[0].inject(&flywheel(1.0, 0.0)).err().unwrap();
    assert_eq!(mistake.key, "breakaway_nm");
    assert_eq!(mistake.found, "0.5, a number from 0.6 to 1000 was expected");
}
