//! Noise of channels and the cut-off it allows, on signals in closed form.

use std::f64::consts::TAU;

use logs::{ChannelNoise, LogWarning, NoiseSource, PrepareSettings, Prepared, Run, prepare};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::support::{clock, follows, run};

const RATE_HZ: f64 = 250.0;

/// Sinusoids of .15, .4 and 1.1 Hz.
fn motion(t: f64) -> f64 {
    0.6 * (TAU * 0.15 * t).sin() + 0.3 * (TAU * 0.4 * t).cos() + 0.08 * (TAU * 1.1 * t).sin()
}

fn times() -> Vec<f64> {
    clock(7500, RATE_HZ)
}

fn gaussian(random: &mut impl RngExt) -> f64 {
    random.sample(rand_distr::StandardNormal)
}

/// A run of [`motion`] with positions of that noise in steps, zero for none, and an effort of the
/// motion with the noise `effort`.
fn seen(noise: f64, step: f64, effort: f64, seed: u64) -> Run {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let time = times();
    let mut j1 = follows("j1", &time, motion);
    for q in &mut j1.position {
        *q += noise * gaussian(&mut random);
        if step > 0.0 {
            *q = step * (*q / step).round() + 0.01;
        }
    }
    for (tau, q) in j1.effort.iter_mut().zip(&j1.position) {
        *tau = 20.0 * q.sin() + effort * gaussian(&mut random);
    }
    run(time, vec![j1])
}

fn prepared(run: Run) -> Prepared {
    prepare(&[run], &PrepareSettings::default()).unwrap()
}

#[track_caller]
fn near(noise: ChannelNoise, variance: f64, source: NoiseSource) {
    let expected = variance / (0.5 * RATE_HZ);
    assert_eq!(noise.source, source, "{noise:?}");
    assert!((noise.density / expected).log10().abs() < 0.12, "{noise:?}, {expected} expected");
}

#[test]
fn an_encoder_that_is_all_steps_has_a_twelfth_of_their_square() {
    for step in [6.1e-3, 1.5e-3, 2.4e-4] {
        let noise = prepared(seen(0.0, step, 0.0, 1)).noise[0];
        near(noise.position, step * step / 12.0, NoiseSource::Step);
        let found = noise.position.step.unwrap();
        assert!((found / step - 1.0).abs() < 1e-3, "{found} {step}");
    }
}

#[test]
fn white_noise_is_found_above_the_motion() {
    for (deviation, effort) in [(1e-3, 0.2), (3e-5, 0.01)] {
        for seed in 0..4 {
            let noise = prepared(seen(deviation, 0.0, effort, seed)).noise[0];
            near(noise.position, deviation * deviation, NoiseSource::AboveTheMotion);
            near(
                noise.effort,
                effort * effort + (20.0 * deviation).powi(2),
                NoiseSource::AboveTheMotion,
            );
            assert_eq!(noise.position.step, None);
        }
    }
}

#[test]
fn a_slow_joint_has_its_rounding_at_low_frequencies() {
    let time = times();
    let (step, speed) = (1e-2, 0.05);
    let swing = |t: f64| step * (0.4 * (TAU * speed / 0.4 / TAU * t).sin() / step).round();
    let slow = run(time.clone(), vec![follows("j1", &time, swing)]);
    let noise = prepared(slow).noise[0].position;
    // About .03 rad/s over steps of .01 rad: three counts a second, not 125.
    assert_eq!(noise.source, NoiseSource::Step);
    let band_hz = step * step / 12.0 / noise.density;
    assert!((2.0..6.0).contains(&band_hz), "{band_hz}");
}

/// The second derivative of white noise behind the low-pass, measured on noise alone.
#[test]
fn noise_of_the_acceleration_is_that_of_its_equation() {
    let still = |seed: u64, cutoff_hz: f64| {
        let quiet = prepared(seen(1e-3, 0.0, 0.1, seed));
        let settings = PrepareSettings { cutoff_hz: Some(cutoff_hz) };
        let loud = prepare(&[seen(1e-3, 0.0, 0.1, seed)], &settings).unwrap();
        let exact = prepare(&[seen(0.0, 0.0, 0.1, seed)], &settings).unwrap();
        let off = |k: fn(&logs::PreparedJoint) -> &Vec<f64>| {
            let pairs = k(&loud.runs[0].joints[0]).iter().zip(k(&exact.runs[0].joints[0]));
            let (n, sum) = pairs.fold((0.0, 0.0), |(n, s), (a, b)| (n + 1.0, s + (a - b).powi(2)));
            f64::sqrt(sum / n)
        };
        let noise = quiet.noise[0];
        let velocity = off(|j| &j.qd) / noise.velocity_rms(cutoff_hz);
        (off(|j| &j.qdd) / noise.acceleration_rms(cutoff_hz), velocity)
    };
    for (seed, cutoff_hz) in [(1, 5.0), (2, 10.0), (3, 20.0)] {
        let (acceleration, velocity) = still(seed, cutoff_hz);
        assert!((0.85..1.15).contains(&acceleration), "{cutoff_hz} Hz: {acceleration}");
        assert!((0.85..1.15).contains(&velocity), "{cutoff_hz} Hz: {velocity}");
    }
}

#[test]
fn a_log_that_was_low_passed_does_not_tell_its_noise() {
    let mut smooth = seen(1e-3, 0.0, 0.1, 3);
    // Behind 3 Hz there is no octave and a half between the motion and the low-pass.
    let low_pass = logs::LowPass::new(8, 3.0, RATE_HZ).unwrap();
    let joint = &mut smooth.joints[0];
    low_pass.apply(&mut joint.position);
    low_pass.apply(&mut joint.effort);
    let noise = prepared(smooth).noise[0];
    assert_eq!(noise.position.source, NoiseSource::Unknown);
    assert_eq!(noise.effort.source, NoiseSource::Unknown);
}

#[test]
fn the_cutoff_of_a_coarse_encoder_is_where_its_noise_is_a_few_per_cent() {
    let fine = prepared(seen(0.0, 0.0, 0.1, 1));
    assert!(fine.cutoff_reason.contains("five times that is kept"), "{}", fine.cutoff_reason);
    let mut last = fine.cutoff_hz;
    for step in [6.1e-3, 1.2e-2, 2.4e-2] {
        let coarse = prepared(seen(0.0, step, 0.1, 1));
        let (reason, cutoff_hz) = (&coarse.cutoff_reason, coarse.cutoff_hz);
        assert!(cutoff_hz < last && cutoff_hz >= 1.0, "{reason}");
        assert!(reason.contains("the encoder of j1, in steps of"), "{reason}");
        assert!((coarse.motion_hz / fine.motion_hz - 1.0).abs() < 0.2, "{reason}");
        last = cutoff_hz;
    }
}

#[test]
fn a_joint_whose_acceleration_is_noise_is_told() {
    let told = |step: f64| {
        let warnings = prepared(seen(0.0, step, 0.1, 1)).warnings;
        warnings.iter().any(|w| matches!(w, LogWarning::NoisyAcceleration { .. }))
    };
    assert!(told(0.1));
    assert!(!told(1.5e-3));
}
