//! The lag between two encoders of a joint, on motions in closed form.

use std::f64::consts::TAU;

use logs::{LogWarning, PrepareSettings, Prepared, prepare};

use crate::support::{clock, follows, run};

const MOTION: [(f64, f64, f64); 3] = [(0.6, 0.15, 0.3), (0.3, 0.43, 1.1), (0.08, 1.1, 2.0)];

/// Position of the motor.
fn q(t: f64) -> f64 {
    MOTION.iter().map(|(a, hz, p)| a * (TAU * hz * t + p).sin()).sum()
}

/// Its acceleration.
fn qdd(t: f64) -> f64 {
    MOTION.iter().map(|(a, hz, p)| -a * (TAU * hz).powi(2) * (TAU * hz * t + p).sin()).sum()
}

/// What encoders of 17 and 18 bits say of a motor and of a link behind a spring (N m/rad) under
/// 2 kg m2 and a gravity of 40 N m, the link's later by a time (s).
fn seen(stiffness: Option<f64>, lag_s: f64) -> Prepared {
    let time = clock(20_000, 500.0);
    let counted = |q: f64, bits: i32| {
        let step = TAU / 2_f64.powi(bits);
        step * (q / step).round()
    };
    let twist = |t: f64| stiffness.map_or(0.0, |k| (2.0 * qdd(t) + 40.0 * q(t).sin()) / k);
    let mut j1 = follows("j1", &time, |t| counted(q(t), 17));
    let link = |t: f64| counted(q(t - lag_s) - twist(t - lag_s), 18);
    j1.link_position = Some(time.iter().map(|t| link(*t)).collect());
    prepare(&[run(time, vec![j1])], &PrepareSettings::default()).unwrap()
}

fn lag(prepared: &Prepared) -> Option<(f64, f64)> {
    prepared.warnings.iter().find_map(|warning| match warning {
        LogWarning::LinkLag { lag_s, lag_std_s, .. } => Some((*lag_s, *lag_std_s)),
        _ => None,
    })
}

#[test]
fn a_late_second_encoder_is_moved_and_told() {
    for (stiffness, late_s) in
        [(None, 3e-3), (Some(5000.0), 3e-3), (Some(2000.0), -1e-3), (None, 0.015)]
    {
        let prepared = seen(stiffness, late_s);
        let (lag_s, std_s) = lag(&prepared).unwrap();
        assert!((lag_s - late_s).abs() < 3e-5 + 3.0 * std_s, "{late_s}: {lag_s} {std_s}");
        assert!(std_s < 0.1 * late_s.abs(), "{std_s}");
        // What is left of the twist is that of the spring.
        let run = &prepared.runs[0];
        let twist = &run.joints[0].link.as_ref().unwrap().twist;
        let expected = |t: f64| stiffness.map_or(0.0, |k| (2.0 * qdd(t) + 40.0 * q(t).sin()) / k);
        let off = run.time.iter().zip(twist).map(|(t, x)| (x - expected(*t)).powi(2));
        let off = (off.sum::<f64>() / twist.len() as f64).sqrt();
        assert!(off < 5e-5, "{off}");
    }
}

#[test]
fn a_spring_is_no_lag() {
    for stiffness in [1000.0, 3000.0, 10_000.0] {
        let prepared = seen(Some(stiffness), 0.0);
        assert_eq!(lag(&prepared), None, "{stiffness}");
    }
    assert_eq!(lag(&seen(None, 0.0)), None);
}
