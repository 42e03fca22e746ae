//! Mean, variance and the three ways of having a linear part, against other programs.

use gaussian_process::{
    GaussianKernel, Inverse, KernelSearch, KernelSum, Likelihood, Linear, LinearPosterior,
    ResidualProcess, SearchEnd,
};

use crate::golden::{Golden, golden};

/// Values that scikit-learn prints are good to this much.
const PRINTED: f64 = 1e-8;

/// Closed forms of sixty points, condition number some thousands.
const CLOSED: f64 = 1e-9;

fn kernel(g: &Golden, lambda: f64) -> GaussianKernel {
    let signal_variance = lambda * g.signal_variance;
    GaussianKernel { signal_variance, length_scales: g.length_scales.clone() }
}

fn inverse(g: &Golden, lambda: f64) -> Inverse {
    let likelihood = Likelihood::new(&g.points.concat(), g.length_scales.len()).unwrap();
    likelihood.condition(&kernel(g, lambda), g.noise_variance).unwrap()
}

/// `phi' beta + k_star' alpha` at every query.
fn predicted(g: &Golden, lambda: f64, beta: &[f64], alpha: &[f64]) -> Vec<f64> {
    let width = g.length_scales.len();
    let kernels = [kernel(g, lambda)];
    let sum = KernelSum::new(&g.points.concat(), width, &kernels, &[alpha.to_vec()]).unwrap();
    let features = g.semiparametric.query_features.iter();
    let queries = g.queries.iter().zip(features);
    queries
        .map(|(x, phi)| {
            let mut f = [0.0];
            sum.evaluate_into(x, &mut f);
            f[0] + phi.iter().zip(beta).map(|(p, b)| p * b).sum::<f64>()
        })
        .collect()
}

fn check(found: &[f64], expected: &[f64], tolerance: f64) {
    assert_eq!(found.len(), expected.len());
    for (i, (f, e)) in found.iter().zip(expected).enumerate() {
        assert!((f - e).abs() <= tolerance * e.abs().max(1.0), "{i}: {f} instead of {e}");
    }
}

#[test]
fn oracle_mean_and_deviation_are_those_of_scikit_learn() {
    let g = golden();
    let inverse = inverse(&g, 1.0);
    let residual = ResidualProcess::new(&inverse, &g.targets, Linear::NONE).unwrap();
    check(&predicted(&g, 1.0, &[], &residual.alpha), &g.mean, PRINTED);
    let width = g.length_scales.len();
    let kernels = [kernel(&g, 1.0)];
    let sum = KernelSum::new(&g.points.concat(), width, &kernels, &[residual.alpha]).unwrap();
    let deviation = |x: &Vec<f64>| {
        let n = g.points.len();
        let (mut k_star, mut solved) = (vec![0.0; n], vec![0.0; n]);
        sum.covariances_into(0, x, &mut k_star);
        inverse.multiply(&k_star, &mut solved);
        let explained: f64 = k_star.iter().zip(&solved).map(|(k, s)| k * s).sum();
        (g.signal_variance - explained + g.noise_variance).sqrt()
    };
    let found: Vec<f64> = g.queries.iter().map(deviation).collect();
    check(&found, &g.latent_plus_noise_std, PRINTED);
}

#[test]
fn oracle_equation_5_a_fixed_linear_part() {
    let g = golden();
    let features = g.semiparametric.features.concat();
    let linear = Linear { features: &features, mean: &g.semiparametric.beta0 };
    let residual = ResidualProcess::new(&inverse(&g, 1.0), &g.targets, linear).unwrap();
    let found = predicted(&g, 1.0, linear.mean, &residual.alpha);
    check(&found, &g.semiparametric.mean_fixed_beta, CLOSED);
}

fn posterior(
    residual: &ResidualProcess,
    variances: &[f64],
    mean: &[f64],
) -> (LinearPosterior, Vec<f64>) {
    let posterior = residual.evidence.posterior(variances).unwrap();
    let beta = mean.iter().zip(&posterior.change).map(|(b, c)| b + c).collect();
    (posterior, beta)
}

#[test]
fn oracle_equation_7_a_prior_on_the_linear_part() {
    let g = golden();
    let s = &g.semiparametric;
    let features = s.features.concat();
    let linear = Linear { features: &features, mean: &s.beta0 };
    let residual = ResidualProcess::new(&inverse(&g, 1.0), &g.targets, linear).unwrap();
    let (posterior, beta) = posterior(&residual, &s.prior_variances, &s.beta0);
    check(&beta, &s.beta_bar, CLOSED);
    let found = predicted(&g, 1.0, &beta, &residual.alpha(&posterior.change));
    check(&found, &s.mean_prior_beta, CLOSED);
}

#[test]
fn oracle_equation_10_a_linear_kernel_beside_the_gaussian_one() {
    let g = golden();
    let s = &g.semiparametric;
    let (features, origin) = (s.features.concat(), vec![0.0; s.beta0.len()]);
    let linear = Linear { features: &features, mean: &origin };
    let residual = ResidualProcess::new(&inverse(&g, s.lambda), &g.targets, linear).unwrap();
    let (posterior, beta) = posterior(&residual, &s.kernel_variances, &origin);
    let found = predicted(&g, s.lambda, &beta, &residual.alpha(&posterior.change));
    check(&found, &s.mean_rbd_kernel, CLOSED);
}

/// `log N(y; Phi beta_0, k + Phi B Phi' + noise)` point by point: the sum of the logarithms of
/// the densities of each target given those before it, each from a solve of its own.
fn chain_rule(g: &Golden, count: usize) -> f64 {
    let s = &g.semiparametric;
    let kernel = kernel(g, 1.0);
    let covariance = |i: usize, j: usize| {
        let linear: f64 = (0..s.beta0.len())
            .map(|c| s.features[i][c] * s.prior_variances[c] * s.features[j][c])
            .sum();
        let noise = if i == j { g.noise_variance } else { 0.0 };
        kernel.value(&g.points[i], &g.points[j]) + linear + noise
    };
    let left = |i: usize| {
        g.targets[i] - s.features[i].iter().zip(&s.beta0).map(|(p, b)| p * b).sum::<f64>()
    };
    (0..count)
        .map(|i| {
            let before = nalgebra::DMatrix::from_fn(i, i, &covariance);
            let with = nalgebra::DVector::from_fn(i, |j, _| covariance(i, j));
            let known = nalgebra::DVector::from_fn(i, |j, _| left(j));
            let weights = if i == 0 { with.clone() } else { before.lu().solve(&with).unwrap() };
            let variance = covariance(i, i) - weights.dot(&with);
            let error = left(i) - weights.dot(&known);
            -0.5 * (error * error / variance + (std::f64::consts::TAU * variance).ln())
        })
        .sum()
}

#[test]
fn oracle_the_evidence_with_a_prior_is_the_product_of_predictive_densities() {
    let g = golden();
    let s = &g.semiparametric;
    let features = s.features.concat();
    let linear = Linear { features: &features, mean: &s.beta0 };
    let residual = ResidualProcess::new(&inverse(&g, 1.0), &g.targets, linear).unwrap();
    let found = residual.evidence.posterior(&s.prior_variances).unwrap().log_likelihood;
    let expected = chain_rule(&g, g.targets.len());
    assert!((found - expected).abs() < 1e-8, "{found} instead of {expected}");
}

#[test]
fn oracle_held_out_errors_are_those_of_refitting_without_the_stretch() {
    let g = golden();
    let s = &g.semiparametric;
    let (features, origin) = (s.features.concat(), vec![0.0; s.beta0.len()]);
    let linear = Linear { features: &features, mean: &origin };
    let whole = inverse(&g, 1.0);
    let residual = ResidualProcess::new(&whole, &g.targets, linear).unwrap();
    let weights = residual.evidence.posterior(&s.kernel_variances).unwrap();
    let found = residual.held_out_square(&whole, &weights, 4).unwrap();
    let kernel = kernel(&g, 1.0);
    let covariance = |i: usize, j: usize| {
        let linear: f64 = (0..origin.len())
            .map(|c| s.features[i][c] * s.kernel_variances[c] * s.features[j][c])
            .sum();
        kernel.value(&g.points[i], &g.points[j]) + linear
    };
    let mut square = 0.0;
    for fold in 0..4 {
        let out = 15 * fold..15 * (fold + 1);
        let kept: Vec<usize> = (0..60).filter(|i| !out.contains(i)).collect();
        let noise = |a: usize, b: usize| if a == b { g.noise_variance } else { 0.0 };
        let k =
            nalgebra::DMatrix::from_fn(45, 45, |a, b| covariance(kept[a], kept[b]) + noise(a, b));
        let y = nalgebra::DVector::from_fn(45, |a, _| g.targets[kept[a]]);
        let alpha = k.lu().solve(&y).unwrap();
        for i in out {
            let mean: f64 = (0..45).map(|a| covariance(i, kept[a]) * alpha[a]).sum();
            square += (g.targets[i] - mean).powi(2);
        }
    }
    let expected = square / 60.0;
    assert!((found / expected - 1.0).abs() < 1e-8, "{found} instead of {expected}");
}

#[test]
fn oracle_the_posterior_passes_through_targets_without_noise() {
    let g = golden();
    let likelihood = Likelihood::new(&g.points.concat(), g.length_scales.len()).unwrap();
    let inverse = likelihood.condition(&kernel(&g, 1.0), 1e-10).unwrap();
    let residual = ResidualProcess::new(&inverse, &g.targets, Linear::NONE).unwrap();
    let mut at_points = golden();
    at_points.queries = g.points;
    at_points.semiparametric.query_features = vec![Vec::new(); g.targets.len()];
    check(&predicted(&at_points, 1.0, &[], &residual.alpha), &g.targets, 1e-6);
}

/// Optimum of the same likelihood within the same bounds by SciPy 1.17.1 (L-BFGS-B from the
/// first of the starts, `ftol=1e-13, gtol=1e-7`; likelihood by NumPy), and of its nonzero terms:
/// logarithms of signal variance, of length scales 1, 4 and 8, and of the noise variance.
const SCIPY_OPTIMUM: f64 = 4.072_206_300_957_795;
const SCIPY_AT: [(usize, f64); 5] =
    [(0, 1.5816), (1, 0.9634), (4, 1.3939), (8, 1.0762), (22, -5.067)];

#[test]
fn oracle_the_search_ends_where_that_of_scipy_does() {
    let g = golden();
    let all = KernelSearch { starts: 1, start_points: 60, iterations: 500 };
    let width = g.length_scales.len();
    let on = |_, _| std::ops::ControlFlow::Continue(());
    let found = all.run(&g.points.concat(), width, &g.targets, &on).unwrap();
    assert_eq!(found.end, SearchEnd::Converged);
    assert!((found.log_likelihood - SCIPY_OPTIMUM).abs() < 1e-5, "{found:?}");
    let at = |i: usize| match i {
        0 => found.kernel.signal_variance.ln(),
        i if i == width + 1 => found.noise_variance.ln(),
        i => found.kernel.length_scales[i - 1].ln(),
    };
    for (i, expected) in SCIPY_AT {
        assert!((at(i) - expected).abs() < 5e-3, "{i}: {} instead of {expected}", at(i));
    }
}

#[test]
fn inputs_that_tell_nothing_are_no_reason_to_stop() {
    let on = |_, _| std::ops::ControlFlow::Continue(());
    let search = KernelSearch { starts: 2, start_points: 20, iterations: 50 };
    let x: Vec<f64> = (0..40).map(|i| f64::from(i % 20) * 0.1).collect();
    let wave: Vec<f64> = x.iter().map(|x| x.sin()).collect();
    // Every point twice, constant targets, targets of zero, a constant input, one point.
    for (inputs, targets) in [
        (x.clone(), wave.clone()),
        (x.clone(), vec![3.0; 40]),
        (x.clone(), vec![0.0; 40]),
        (vec![0.5; 40], wave),
        (vec![0.5], vec![2.0]),
    ] {
        let found = search.run(&inputs, 1, &targets, &on).unwrap();
        let likelihood = Likelihood::new(&inputs, 1).unwrap();
        let inverse = likelihood.condition(&found.kernel, found.noise_variance).unwrap();
        let residual = ResidualProcess::new(&inverse, &targets, Linear::NONE).unwrap();
        assert!(residual.alpha.iter().all(|a| a.is_finite()), "{found:?}");
    }
    assert!(search.run(&[], 1, &[], &on).is_err());
    assert!(search.run(&[f64::NAN, 1.0], 1, &[0.0, 1.0], &on).is_err());
    assert!(search.run(&[0.0, 1.0], 1, &[0.0, f64::NAN], &on).is_err());
}
