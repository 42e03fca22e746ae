//! The low-pass and the derivative against other programs and closed forms.

use std::f64::consts::TAU;

use logs::{LogError, LowPass, decimate, differentiate};
use serde::Deserialize;

use crate::support::root;

#[derive(Deserialize)]
struct Golden {
    x: Vec<f64>,
    cases: Vec<Case>,
}

#[derive(Deserialize)]
struct Case {
    order: usize,
    cutoff_hz: f64,
    rate_hz: f64,
    y: Vec<f64>,
}

#[test]
fn oracle_low_pass_agrees_with_scipy_sosfiltfilt_to_the_edges() {
    // Both work in f64; a 4th-order filter at 1/250 of the rate loses about 5 digits.
    const TOLERANCE: f64 = 1e-10;
    let text = std::fs::read_to_string(root().join("tests/golden/sosfiltfilt.json")).unwrap();
    let golden: Golden = serde_json::from_str(&text).unwrap();
    assert_eq!(golden.cases.len(), 4);
    for case in &golden.cases {
        let mut x = golden.x.clone();
        LowPass::new(case.order, case.cutoff_hz, case.rate_hz).unwrap().apply(&mut x);
        for (k, (ours, theirs)) in x.iter().zip(&case.y).enumerate() {
            let order = case.order;
            assert!((ours - theirs).abs() < TOLERANCE, "order {order}, {k}: {ours} {theirs}");
        }
    }
}

#[test]
fn oracle_low_pass_has_the_gain_of_its_equation_and_no_phase() {
    let (rate, cutoff, count) = (500.0, 10.0, 5000);
    for frequency in [2.0, 5.0, 10.0, 15.0] {
        let sine = |k: usize| (TAU * frequency * k as f64 / rate).sin();
        let mut x: Vec<f64> = (0..count).map(sine).collect();
        LowPass::new(4, cutoff, rate).unwrap().apply(&mut x);
        let warped = |f: f64| (std::f64::consts::PI * f / rate).tan();
        let gain = 1.0 / (1.0 + (warped(frequency) / warped(cutoff)).powi(8));
        for (k, y) in x.iter().enumerate().take(count - 1000).skip(1000) {
            assert!((y - gain * sine(k)).abs() < 1e-9, "{frequency} Hz, sample {k}");
        }
    }
}

#[test]
fn low_pass_keeps_a_straight_line_and_signals_of_any_length() {
    let filter = LowPass::new(4, 3.0, 100.0).unwrap();
    for length in [0, 1, 2, 5, 15, 16, 200] {
        let line: Vec<f64> = (0..length).map(|k| 3.0 + 0.1 * k as f64).collect();
        let mut x = line.clone();
        filter.apply(&mut x);
        assert_eq!(x.len(), length);
        assert!(x.iter().all(|v| v.is_finite()));
        if length < 2 {
            assert!(x.iter().zip(&line).all(|(a, b)| (a - b).abs() < 1e-9));
        }
    }
    let mut constant = vec![2.5; 40];
    filter.apply(&mut constant);
    assert!(constant.iter().all(|v| (v - 2.5).abs() < 1e-9));
}

/// Of one, two and three sections; one to nine signals leave every number of them over from four.
#[test]
fn signals_side_by_side_pass_as_each_does_alone() {
    let signal = |k: usize| -> Vec<f64> {
        (0..300).map(|t| (0.03 * (k + 1) as f64 * t as f64).sin() + k as f64).collect()
    };
    for order in [2, 3, 4, 5] {
        let low_pass = LowPass::new(order, 4.0, 100.0).unwrap();
        for count in 1..10 {
            let mut together: Vec<Vec<f64>> = (0..count).map(signal).collect();
            let mut alone = together.clone();
            low_pass.apply_all(&mut together);
            alone.iter_mut().for_each(|x| low_pass.apply(x));
            assert_eq!(together, alone, "{count} signals, order {order}");
        }
    }
}

#[test]
fn low_pass_refuses_orders_and_cutoffs_it_cannot_have() {
    let highest = LowPass::HIGHEST_ORDER;
    assert_eq!(LowPass::new(0, 1.0, 10.0), Err(LogError::FilterOrder { found: 0, highest }));
    assert_eq!(LowPass::new(13, 1.0, 10.0), Err(LogError::FilterOrder { found: 13, highest }));
    for found_hz in [0.0, -1.0, 5.0] {
        let expected = LogError::CutoffOutOfRange { found_hz, nyquist_hz: 5.0 };
        assert_eq!(LowPass::new(4, found_hz, 10.0), Err(expected));
    }
    assert!(LowPass::new(4, f64::NAN, 10.0).is_err());
}

/// The m-th sample from either end has m neighbours on both sides, at most six: a central difference of order 2 m, whose
/// gain on a sine is `1 - (m!)^2 step^(2 m) / (2 m + 1)!`.
#[test]
fn oracle_derivative_of_a_sine_has_the_error_of_its_equation() {
    let (rate, omega) = (100.0, 20.0);
    let step: f64 = omega / rate;
    let x: Vec<f64> = (0..400).map(|k| (omega * f64::from(k) / rate).sin()).collect();
    let found = differentiate(&x, rate);
    let factorial = |n: i32| (1..=n).map(f64::from).product::<f64>();
    for m in 1..=6 {
        let predicted = factorial(m).powi(2) / factorial(2 * m + 1) * step.powi(2 * m);
        let error = 1.0 - found[m as usize] / (omega * (step * f64::from(m)).cos());
        assert!((error / predicted - 1.0).abs() < 0.02, "{m}: {error} {predicted}");
    }
    let inner = found.iter().enumerate().skip(6).take(388);
    let error = |(k, d): (usize, &f64)| (d - omega * (step * k as f64).cos()).abs() / omega;
    let worst = inner.map(error).fold(0.0, f64::max);
    assert!(worst < 1e-12, "{worst}");
}

#[test]
fn derivative_of_a_line_is_its_slope_at_the_ends_too() {
    let x: Vec<f64> = (0..7).map(|k| 0.5 * f64::from(k)).collect();
    assert!(differentiate(&x, 10.0).iter().all(|d| (d - 5.0).abs() < 1e-12));
    assert_eq!(differentiate(&[4.0], 10.0), [0.0]);
}

#[test]
fn decimation_takes_every_third_sample() {
    assert_eq!(decimate(&[0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0], 3), [0.0, 3.0, 6.0]);
    assert_eq!(decimate(&[1.0, 2.0], 0), [1.0, 2.0]);
}
