use std::f64::consts::TAU;

use nalgebra::Complex;
use robot::{Machine, Reading};
use simulator::{EffortSource, JointSensor, LinkEncoder, PositionSide, Sensors, VelocitySource};

use crate::rig::{Row, STEPPING, flywheel, phasor, run, sensing, simulator};

const FREQUENCY_HZ: f64 = 5.0;

/// A second of a wheel that swings at 5 Hz, after 0.1 s.
fn swing(toml: &str) -> Vec<Row> {
    let mut wheel = simulator(&flywheel(0.4, 0.1), toml, STEPPING).unwrap();
    wheel.start(&[0.2]);
    let torque = |t: f64| 2.0 * (TAU * FREQUENCY_HZ * t).sin();
    run(&mut wheel, 1.1, |r| vec![torque(r.time_s)]).unwrap().split_off(50)
}

fn skewed(skew_ms: f64) -> Vec<Row> {
    swing(&format!("[[effect]]\ntime_skew = {{ joint = 'joint', skew_ms = {skew_ms} }}"))
}

fn column(rows: &[Row], value: impl Fn(&Row) -> f64) -> Complex<f64> {
    let samples: Vec<_> = rows.iter().map(|r| (r.time_s, value(r))).collect();
    phasor(&samples, FREQUENCY_HZ)
}

/// Later by `skew`: phase `-w skew`, and of amplitude at most the `(w h)² / 8` that straight lines
/// between rows `h` apart lose. Only the log shows it.
#[test]
fn oracle_the_log_has_one_of_effort_and_motion_late_by_the_skew() {
    let clean = swing("effect = []");
    for skew_ms in [0.7, 5.3, -0.7, -5.3] {
        let rows = skewed(skew_ms);
        let still = |value: fn(&Row) -> f64| {
            assert_eq!(
                rows.iter().map(value).collect::<Vec<_>>(),
                clean.iter().map(value).collect::<Vec<_>>()
            );
        };
        let late = |value: fn(&Row) -> f64| {
            let ratio = column(&rows, value) / column(&clean, value);
            let phase = -1e-3 * TAU * FREQUENCY_HZ * f64::abs(skew_ms);
            assert!((ratio.arg() - phase).abs() < 1e-4, "{skew_ms} ms: {}", ratio.arg());
            assert!((ratio.norm() - 1.0).abs() < 5e-4, "{skew_ms} ms: {}", ratio.norm());
        };
        let (q, qd, effort) =
            (|r: &Row| r.logged.q[0], |r: &Row| r.logged.qd[0], |r: &Row| r.logged.effort[0]);
        still(|r| r.q_true[0]);
        if skew_ms > 0.0 {
            late(effort);
            still(q);
            still(qd);
        } else {
            late(qd);
            still(effort);
        }
    }
}

/// Whole rows: the values of an earlier row, the position's too.
#[test]
fn oracle_a_skew_of_whole_rows_shows_earlier_rows() {
    let clean = swing("effect = []");
    for (late, early) in skewed(4.0)[2..].iter().zip(&clean) {
        assert!((late.logged.effort[0] - early.logged.effort[0]).abs() < 1e-12);
    }
    for (late, early) in skewed(-4.0)[2..].iter().zip(&clean) {
        assert!((late.logged.q[0] - early.logged.q[0]).abs() < 1e-12);
        assert!((late.logged.qd[0] - early.logged.qd[0]).abs() < 1e-12);
    }
}

/// A second encoder is late with the first one, and only where that is.
#[test]
fn oracle_a_skew_of_whole_rows_shows_the_links_of_earlier_rows() {
    let links = |skew_ms: f64| {
        let effect = format!("[[effect]]\ntime_skew = {{ skew_ms = {skew_ms} }}");
        let encoder = LinkEncoder { resolution: 0.0, noise: 0.0 };
        let sensors = Sensors::perfect(1).with_links(vec![Some(encoder)]);
        let mut wheel = sensing(&flywheel(0.4, 0.1), &effect, STEPPING, sensors).unwrap();
        wheel.start_moving(&[0.2], &[1.0]);
        let mut reading = Reading::zero(1);
        let mut row = || {
            wheel.read(&mut reading).unwrap();
            wheel.actuate(&[0.0]).unwrap();
            wheel.record_links(&reading)[0].unwrap()
        };
        (0..10).map(|_| row()).collect::<Vec<f64>>()
    };
    let clean = links(0.0);
    assert!((clean[9] - clean[0] - 9.0 * 2e-3).abs() < 1e-6, "{clean:?}");
    assert_eq!(links(4.0), clean);
    let late = links(-4.0);
    assert!(late[2..].iter().zip(&clean).all(|(l, c)| (l - c).abs() < 1e-12), "{late:?}");
}

/// A torque sensor that is read at another time is as noisy as ever: 20000 draws, within 2 %.
#[test]
fn oracle_a_skew_of_half_a_row_leaves_the_noise_of_the_effort_as_it_is() {
    let joint = JointSensor { resolution: 0.0, position_noise: 0.0, effort_noise: 0.03 };
    let (side, source) = (PositionSide::Motor, EffortSource::Motor);
    let noisy = Sensors::new(side, source, VelocitySource::Ideal, vec![joint], 7);
    let effect = "[[effect]]\ntime_skew = { skew_ms = 1.0 }";
    let mut wheel = sensing(&flywheel(0.4, 0.1), effect, STEPPING, noisy).unwrap();
    wheel.start(&[0.0]);
    let rows = run(&mut wheel, 40.0, |_| vec![0.0]).unwrap();
    let variance = rows.iter().map(|r| r.logged.effort[0].powi(2)).sum::<f64>() / rows.len() as f64;
    assert!((variance.sqrt() / 0.03 - 1.0).abs() < 0.02, "{} N m", variance.sqrt());
}
