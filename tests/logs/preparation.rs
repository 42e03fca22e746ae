//! Uniform clock, derivatives, cut-off.

use std::f64::consts::TAU;

use logs::{LogWarning, PrepareSettings, PreparedRun, Run, prepare};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::support::{clock, follows, run};

const OMEGA: f64 = TAU * 0.8;

fn motion(t: f64) -> f64 {
    (OMEGA * t).sin()
}

/// Largest distance of each prepared signal of the first joint from the sine, as a share
/// of its amplitude, a second away from the ends, where the motion was cut off.
fn errors(run: &PreparedRun) -> [f64; 3] {
    errors_within(run, 1.0)
}

fn errors_within(run: &PreparedRun, ends_s: f64) -> [f64; 3] {
    let skip = (ends_s * run.rate_hz) as usize;
    let kept = skip..run.time.len() - skip;
    let worst = |x: &[f64], exact: fn(f64) -> f64, size: f64| {
        let off = run.time[kept.clone()]
            .iter()
            .zip(&x[kept.clone()])
            .map(|(&t, x)| (x - exact(t)).abs() / size);
        off.fold(0.0, f64::max)
    };
    let joint = &run.joints[0];
    [
        worst(&joint.q, motion, 1.0),
        worst(&joint.qd, |t| OMEGA * (OMEGA * t).cos(), OMEGA),
        worst(&joint.qdd, |t| -OMEGA * OMEGA * (OMEGA * t).sin(), OMEGA * OMEGA),
    ]
}

#[test]
fn velocity_and_acceleration_of_a_sine_are_its_derivatives() {
    let time = clock(4000, 200.0);
    let prepared = prepare(
        &[run(time.clone(), vec![follows("j1", &time, motion)])],
        &PrepareSettings::default(),
    )
    .unwrap();
    assert!(prepared.cutoff_hz >= 2.0 && prepared.cutoff_hz < 10.0, "{}", prepared.cutoff_reason);
    assert_eq!(prepared.warnings, []);
    let errors = errors(&prepared.runs[0]);
    // The low-pass itself takes (0.8 Hz / cut-off)^8 off a sine.
    assert!(errors.iter().all(|&e| e < 1e-4), "{errors:?}");
}

/// `1 / (1 + (f / cut-off)^8)` of a sine is left: half at the cut-off, all but 2e-5 at a quarter.
#[test]
fn wide_signals_have_what_is_as_fast_as_the_cutoff() {
    let time = clock(4000, 200.0);
    let settings = PrepareSettings { cutoff_hz: Some(0.8) };
    let runs = [run(time.clone(), vec![follows("j1", &time, motion)])];
    let mut prepared = prepare(&runs, &settings).unwrap().runs.remove(0);
    let joint = &mut prepared.joints[0];
    let wide = std::mem::take(&mut joint.wide);
    let half = [&joint.q, &joint.qd, &joint.qdd].map(|x| x.iter().map(|x| 2.0 * x).collect());
    let errors_of = |prepared: &PreparedRun| errors_within(prepared, 4.0);
    [joint.q, joint.qd, joint.qdd] = half;
    let doubled = errors_of(&prepared);
    assert!(doubled.iter().all(|&e| e < 1e-3), "{doubled:?}");
    let joint = &mut prepared.joints[0];
    [joint.q, joint.qd, joint.qdd] = [wide.q, wide.qd, wide.qdd];
    let whole = errors_of(&prepared);
    assert!(whole.iter().all(|&e| e < 1e-3), "{whole:?}");
}

/// `q = motion - twist` of a link whose motor follows [`motion`].
#[test]
fn the_motion_of_a_link_and_its_twist_are_those_of_its_encoder() {
    let time = clock(4000, 200.0);
    let twist = |t: f64| 0.01 * (3.0 * OMEGA * t).sin() + 0.002;
    let mut j1 = follows("j1", &time, |t| motion(t) + twist(t));
    j1.link_position = Some(time.iter().map(|&t| motion(t)).collect());
    let recorded = run(time, vec![j1]);
    let settings = PrepareSettings { cutoff_hz: Some(8.0) };
    let prepared = prepare(std::slice::from_ref(&recorded), &settings).unwrap();
    assert_eq!(prepared.warnings, []);
    let mut whole = prepared.runs[0].clone();
    let link = whole.joints[0].link.take().unwrap();
    for (t, x) in whole.time.iter().zip(&link.twist) {
        assert!((x - twist(*t)).abs() < 1e-12, "{x} at {t}");
    }
    let joint = &mut whole.joints[0];
    (joint.q, joint.qd, joint.qdd) = (link.q, link.qd, link.qdd);
    let errors = errors(&whole);
    assert!(errors.iter().all(|&e| e < 1e-4), "{errors:?}");
    let part = prepared.runs[0].part(10..20).joints.remove(0).link.unwrap();
    assert_eq!(part.twist, link.twist[10..20]);
}

#[test]
fn a_second_encoder_that_some_runs_lack_is_left_out_of_all() {
    let time = clock(4000, 200.0);
    let named = |name: &str, has: bool| {
        let mut joint = follows("j1", &time, motion);
        joint.link_position = has.then(|| joint.position.clone());
        Run { name: name.to_owned(), ..run(time.clone(), vec![joint]) }
    };
    let settings = PrepareSettings { cutoff_hz: Some(8.0) };
    let mut runs = [named("a", true), named("b", false)];
    runs[1].joints[0].effort[0] += 1.0;
    let prepared = prepare(&runs, &settings).unwrap();
    let expected = LogWarning::LinkPositionMissing { run: "b".to_owned(), joint: "j1".to_owned() };
    assert_eq!(prepared.warnings, [expected]);
    assert!(prepared.runs.iter().all(|run| run.joints[0].link.is_none()));
}

#[test]
fn little_is_left_of_the_filters_settling_at_the_ends() {
    let time = clock(4000, 200.0);
    let cut = run(time.clone(), vec![follows("j1", &time, |t| motion(t + 0.3))]);
    let prepared = prepare(&[cut], &PrepareSettings { cutoff_hz: Some(5.0) }).unwrap();
    let shifted = PreparedRun {
        time: prepared.runs[0].time.iter().map(|t| t + 0.3).collect(),
        ..prepared.runs[0].clone()
    };
    let errors = errors_within(&shifted, 0.0);
    assert!(errors.iter().all(|&e| e < 0.05), "{errors:?}");
    assert!(errors[2] > 10.0 * errors_within(&shifted, 1.0)[2], "{errors:?}");
}

#[test]
fn a_clock_that_is_uniform_is_left_alone_and_both_ends_are_cut() {
    let time: Vec<f64> = clock(1000, 100.0).iter().map(|t| t + 17.0).collect();
    let recorded = run(time.clone(), vec![follows("j1", &time, motion)]);
    let prepared =
        prepare(std::slice::from_ref(&recorded), &PrepareSettings { cutoff_hz: Some(5.0) })
            .unwrap();
    let first = &prepared.runs[0];
    assert_eq!(first.time, time[30..970]);
    assert_eq!(first.joints[0].effort, recorded.joints[0].effort[30..970]);
    assert!((first.rate_hz - 100.0).abs() < 1e-12);
}

#[test]
fn a_clock_with_jitter_and_a_short_gap_is_resampled() {
    let mut random = ChaCha8Rng::seed_from_u64(7);
    let mut time: Vec<f64> =
        (0..4000).map(|k| k as f64 * 0.005 + random.random_range(-0.001..0.001)).collect();
    time.drain(2000..2003);
    let prepared = prepare(
        &[run(time.clone(), vec![follows("j1", &time, motion)])],
        &PrepareSettings { cutoff_hz: Some(5.0) },
    )
    .unwrap();
    assert_eq!(prepared.runs.len(), 1);
    let first = &prepared.runs[0];
    assert!((first.rate_hz - 200.0).abs() < 1e-9, "{}", first.rate_hz);
    assert!(first.time.windows(2).all(|t| (t[1] - t[0] - 0.005).abs() < 1e-9));
    let errors = errors(first);
    assert!(errors[0] < 1e-4 && errors[1] < 1e-3 && errors[2] < 5e-3, "{errors:?}");
    assert!(matches!(prepared.warnings[..], [LogWarning::Resampled { .. }]));
}

#[test]
fn a_run_with_a_long_gap_is_split_there() {
    let mut time = clock(4000, 200.0);
    time.drain(1500..1600);
    let prepared = prepare(
        &[run(time.clone(), vec![follows("j1", &time, motion)])],
        &PrepareSettings { cutoff_hz: Some(5.0) },
    )
    .unwrap();
    let names: Vec<&str> = prepared.runs.iter().map(|r| r.name.as_str()).collect();
    assert_eq!(names, ["run part 1", "run part 2"]);
    assert!(prepared.warnings.iter().any(|w| matches!(w, LogWarning::Split { gaps: 1, .. })));
    for piece in &prepared.runs {
        let errors = errors(piece);
        assert!(errors.iter().all(|&e| e < 1e-3), "{errors:?}");
    }
}

#[test]
fn a_velocity_column_is_used_where_it_agrees_and_only_there() {
    let time = clock(4000, 200.0);
    // Positions in steps of 0.01 rad: an acceleration from them shows the steps.
    let coarse = |t: f64| (motion(t) / 0.01).round() * 0.01;
    let with_velocity = |lag: f64, scale: f64| {
        let mut j1 = follows("j1", &time, coarse);
        j1.velocity =
            Some(time.iter().map(|t| scale * OMEGA * (OMEGA * (t - lag)).cos()).collect());
        prepare(&[run(time.clone(), vec![j1])], &PrepareSettings { cutoff_hz: Some(5.0) }).unwrap()
    };
    let good = with_velocity(0.0, 1.0);
    assert_eq!(good.warnings, []);
    assert!(errors(&good.runs[0])[2] < 1e-3);
    for (lag, scale) in [(0.006, 1.0), (0.0, 1.05), (0.0, 57.3)] {
        let bad = with_velocity(lag, scale);
        assert!(
            matches!(bad.warnings[..], [LogWarning::VelocityDisagrees { .. }]),
            "{lag} {scale}"
        );
        let errors = errors(&bad.runs[0]);
        assert!(errors[1] < 0.02 && errors[2] > 1e-3, "derived from the steps: {errors:?}");
    }
}

#[test]
fn an_acceleration_column_is_used_where_it_agrees_and_only_there() {
    let time = clock(4000, 200.0);
    let coarse = |t: f64| (motion(t) / 0.001).round() * 0.001;
    let with_acceleration = |scale: f64| {
        let mut j1 = follows("j1", &time, coarse);
        let exact = |t: &f64| -scale * OMEGA * OMEGA * (OMEGA * t).sin();
        j1.acceleration = Some(time.iter().map(exact).collect());
        prepare(&[run(time.clone(), vec![j1])], &PrepareSettings { cutoff_hz: Some(5.0) }).unwrap()
    };
    let good = with_acceleration(1.0);
    assert_eq!(good.warnings, []);
    assert!(errors(&good.runs[0])[2] < 1e-4);
    let bad = with_acceleration(2.0);
    assert!(matches!(bad.warnings[..], [LogWarning::AccelerationDisagrees { .. }]));
    let errors = errors(&bad.runs[0]);
    assert!(errors[2] > 1e-4 && errors[2] < 0.05, "{errors:?}");
}

/// A sine of the given frequency with white noise of the given size on its position.
fn noisy(frequency: f64, noise: f64, seed: u64) -> logs::Run {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let time = clock(20_000, 1000.0);
    let mut j1 = follows("j1", &time, |t| (TAU * frequency * t).sin());
    for q in &mut j1.position {
        *q += noise * gaussian(&mut random);
    }
    run(time, vec![j1])
}

fn gaussian(random: &mut impl RngExt) -> f64 {
    random.sample(rand_distr::StandardNormal)
}

#[test]
fn the_cutoff_follows_the_motion_and_withstands_noise() {
    for (frequency, noise) in [(1.0, 0.0), (1.0, 1e-5), (3.0, 0.0), (3.0, 1e-5)] {
        let prepared = prepare(&[noisy(frequency, noise, 3)], &PrepareSettings::default()).unwrap();
        let ratio = prepared.cutoff_hz / frequency;
        let reason = &prepared.cutoff_reason;
        assert!((4.5..6.5).contains(&ratio), "{frequency} Hz, noise {noise}: {reason}");
        assert!(reason.contains("99 % of the motion lies below"), "{reason}");
    }
    // A tenth of the power of the velocity is noise.
    let loud = prepare(&[noisy(2.0, 3e-3, 5)], &PrepareSettings::default()).unwrap();
    assert!((9.0..13.0).contains(&loud.cutoff_hz), "{}", loud.cutoff_reason);
}

#[test]
fn the_cutoff_stays_within_its_bounds_and_can_be_given() {
    let slow = prepare(&[noisy(0.05, 0.0, 1)], &PrepareSettings::default()).unwrap();
    assert!((slow.cutoff_hz - 2.0).abs() < 1e-12, "{}", slow.cutoff_reason);
    let time = clock(2000, 10.0);
    let fast = run(time.clone(), vec![follows("j1", &time, |t| (TAU * 1.0 * t).sin())]);
    let fast = prepare(&[fast], &PrepareSettings::default()).unwrap();
    assert!((fast.cutoff_hz - 2.0).abs() < 1e-12, "{}", fast.cutoff_reason);
    let given = prepare(&[noisy(1.0, 0.0, 1)], &PrepareSettings { cutoff_hz: Some(7.5) }).unwrap();
    assert!((given.cutoff_hz - 7.5).abs() < 1e-12);
    assert_eq!(given.cutoff_reason, "7.5 Hz: it was given");
}

#[test]
fn an_unmoved_log_is_prepared_and_says_so() {
    let time = clock(2000, 100.0);
    let still = run(time.clone(), vec![follows("j1", &time, |_| 0.3)]);
    let prepared = prepare(&[still], &PrepareSettings::default()).unwrap();
    assert!(prepared.cutoff_reason.contains("no joint moves"), "{}", prepared.cutoff_reason);
    assert!(prepared.runs[0].joints[0].qdd.iter().all(|a| a.abs() < 1e-6));
}

#[test]
fn a_duplicate_and_a_saturated_effort_are_warned_of() {
    let time = clock(2000, 100.0);
    let mut first = run(time.clone(), vec![follows("j1", &time, motion)]);
    for effort in &mut first.joints[0].effort {
        *effort = effort.clamp(-0.5, 0.5);
    }
    let mut second = first.clone();
    second.name = "copy".to_owned();
    let prepared = prepare(&[first, second], &PrepareSettings::default()).unwrap();
    let expected = LogWarning::Duplicate { run: "copy".to_owned(), of: "run".to_owned() };
    assert!(prepared.warnings.contains(&expected));
    assert!(prepared.warnings.iter().any(|w| matches!(w, LogWarning::Saturated { .. })));
}

#[test]
fn a_lag_that_an_even_motion_cannot_show_is_not_held_against_the_velocity() {
    let time = clock(4000, 1000.0);
    let mut random = ChaCha8Rng::seed_from_u64(11);
    // Even acceleration: a late velocity is the same but for a constant.
    let mut j1 = follows("j1", &time, |t| 0.1 * t * t);
    let noise = |random: &mut ChaCha8Rng| 2e-2 * gaussian(random);
    j1.velocity = Some(time.iter().map(|t| 0.2 * (t - 0.005) + noise(&mut random)).collect());
    let even = prepare(&[run(time.clone(), vec![j1])], &PrepareSettings { cutoff_hz: Some(5.0) });
    assert_eq!(even.unwrap().warnings, []);
}

/// Five dropouts of 9 ms at 1 kHz in a motion of .8 Hz: a 36th of its period.
#[test]
fn dropouts_shorter_than_a_quarter_period_of_the_cutoff_are_filled() {
    let all = clock(10_000, 1000.0);
    let is_lost = |k: usize| k % 1900 > 1890;
    let time: Vec<f64> =
        all.iter().enumerate().filter(|(k, _)| !is_lost(*k)).map(|x| *x.1).collect();
    // Steps of 1e-4 rad: the slope of one sample beside a gap is off by up to .1 rad/s.
    let counted = |t: f64| (motion(t) / 1e-4).round() * 1e-4;
    let recorded = run(time.clone(), vec![follows("j1", &time, counted)]);
    let of = |cutoff_hz: f64| {
        let settings = PrepareSettings { cutoff_hz: Some(cutoff_hz) };
        prepare(std::slice::from_ref(&recorded), &settings).unwrap()
    };
    let filled = of(5.0);
    assert_eq!(filled.runs.len(), 1, "{:?}", filled.warnings);
    assert!(matches!(filled.warnings[..], [LogWarning::Resampled { .. }]));
    let errors = errors(&filled.runs[0]);
    assert!(errors[0] < 1e-4 && errors[1] < 1e-3 && errors[2] < 1e-2, "{errors:?}");
    // A quarter period of 40 Hz is 6 ms.
    assert!(of(40.0).runs.len() > 1);
}
