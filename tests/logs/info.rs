//! What `log_info` says of logs whose faults are known.

use std::f64::consts::TAU;

use logs::{Channel, duplicate_of, log_info};
use robot::JointKind;

use crate::support::{clock, follows, robot, run, two_joints};

fn motion(t: f64) -> f64 {
    (TAU * 0.5 * t).sin() + 0.4 * (TAU * 1.3 * t).sin()
}

fn velocity(t: f64) -> f64 {
    TAU * 0.5 * (TAU * 0.5 * t).cos() + 0.4 * TAU * 1.3 * (TAU * 1.3 * t).cos()
}

#[test]
fn injected_lag_and_scale_of_the_velocity_are_found() {
    let arm = robot(&[("j1", JointKind::Revolute)]);
    let time = clock(4000, 250.0);
    for (lag, scale) in [(0.0, 1.0), (0.0071, 1.1), (-0.003, 0.9), (0.030, 1.0)] {
        let mut j1 = follows("j1", &time, motion);
        j1.velocity = Some(time.iter().map(|t| scale * velocity(t - lag)).collect());
        let info = log_info(&run(time.clone(), vec![j1]), &arm);
        let found = info.joints[0].velocity_agreement.unwrap();
        assert!((found.lag_s - lag).abs() < 1e-4, "lag {} for {lag}", found.lag_s);
        assert!(found.lag_std_s < 1e-3, "{}", found.lag_std_s);
        assert!((found.scale - scale).abs() < 2e-3, "scale {} for {scale}", found.scale);
    }
}

#[test]
fn injected_quantisation_is_found_and_smooth_positions_have_none() {
    let arm = two_joints();
    let time = clock(2000, 500.0);
    let step = TAU / 4096.0;
    let mut coarse = follows("j1", &time, |t| (motion(t) / step).round() * step);
    let info =
        log_info(&run(time.clone(), vec![coarse.clone(), follows("j2", &time, motion)]), &arm);
    let found = info.joints[0].quantisation_step.unwrap();
    assert!((found / step - 1.0).abs() < 1e-9, "{found} {step}");
    assert_eq!(info.joints[1].quantisation_step, None);
    // A joint that stands still has no step to see.
    coarse.position = vec![0.3; time.len()];
    let info = log_info(&run(time, vec![coarse.clone(), coarse]), &arm);
    assert_eq!(info.joints[0].quantisation_step, None);
    assert!(!info.joints[0].moves);
}

#[test]
fn gaps_rate_and_jitter_are_those_put_in() {
    let arm = robot(&[("j1", JointKind::Revolute)]);
    let wobble = |k: usize| if k.is_multiple_of(2) { 1e-4 } else { 0.0 };
    let mut time: Vec<f64> = (0..1000).map(|k| k as f64 * 0.01 + wobble(k)).collect();
    time.drain(400..407);
    let info = log_info(&run(time.clone(), vec![follows("j1", &time, motion)]), &arm);
    assert_eq!(info.samples, 993);
    assert!((info.rate_hz - 100.0).abs() < 1.1, "{}", info.rate_hz);
    assert!((info.jitter_std_s - 1e-4).abs() < 1e-5, "{}", info.jitter_std_s);
    assert!((info.jitter_max_s - 2e-4).abs() < 1e-5, "{}", info.jitter_max_s);
    assert_eq!(info.gaps.len(), 1);
    assert_eq!(info.gaps[0].row, 400);
    assert!((info.gaps[0].length_s - 0.08).abs() < 2e-4);
}

#[test]
fn limits_saturation_and_missing_channels_are_told() {
    let arm = robot(&[("j1", JointKind::Revolute)]);
    let time = clock(1000, 100.0);
    let mut j1 = follows("j1", &time, |t| 0.5 * t);
    j1.effort = time.iter().map(|t| (10.0 * t.sin()).clamp(-8.0, 8.0)).collect();
    let info = log_info(&run(time.clone(), vec![j1]), &arm);
    let joint = &info.joints[0];
    assert!((joint.share_outside_limits - 0.419).abs() < 1e-9, "{}", joint.share_outside_limits);
    let clipped = time.iter().filter(|t| (10.0 * t.sin()).abs() >= 8.0).count() - 2;
    assert!((joint.effort_saturation - clipped as f64 / 1000.0).abs() < 1e-12);
    assert!(joint.missing.contains(&Channel::Velocity));
    assert!(!joint.missing.contains(&Channel::Effort));
    assert!(!joint.suspected_degrees);
    assert_eq!(joint.velocity_agreement, None);
    let unsaturated = run(time.clone(), vec![follows("j1", &time, motion)]);
    assert!(log_info(&unsaturated, &arm).joints[0].effort_saturation < 1e-12);
}

#[test]
fn possible_degrees_are_suspected() {
    let arm = robot(&[("j1", JointKind::Revolute)]);
    let time = clock(1000, 100.0);
    // Beyond twice the limits, but not beyond the full turn from which a log is refused.
    let info = log_info(&run(time.clone(), vec![follows("j1", &time, |t| 6.1 * t.sin())]), &arm);
    assert!(info.joints[0].suspected_degrees);
}

#[test]
fn a_run_under_two_names_is_a_duplicate_and_a_repetition_is_not() {
    let time = clock(100, 100.0);
    let first = run(time.clone(), vec![follows("j1", &time, motion)]);
    let mut again = first.clone();
    again.name = "again".to_owned();
    let mut repetition = first.clone();
    repetition.joints[0].effort[50] += 1e-9;
    let runs = [first, again, repetition];
    assert_eq!(duplicate_of(&runs, 0), None);
    assert_eq!(duplicate_of(&runs, 1), Some(0));
    assert_eq!(duplicate_of(&runs, 2), None);
}
