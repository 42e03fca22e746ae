//! Mean, variance and the three ways of having a linear part, against other programs.

use gaussian_process::{
    GaussianKernel, Inverse, KernelSum, Likelihood, Linear, LinearPosterior, Residual,
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
    let residual = Residual::new(&inverse, &g.targets, Linear::NONE).unwrap();
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
    let residual = Residual::new(&inverse(&g, 1.0), &g.targets, linear).unwrap();
    let found = predicted(&g, 1.0, linear.mean, &residual.alpha);
    check(&found, &g.semiparametric.mean_fixed_beta, CLOSED);
}

fn posterior(residual: &Residual, variances: &[f64], mean: &[f64]) -> (LinearPosterior, Vec<f64>) {
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
    let residual = Residual::new(&inverse(&g, 1.0), &g.targets, linear).unwrap();
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
    let residual = Residual::new(&inverse(&g, s.lambda), &g.targets, linear).unwrap();
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
    let residual = Residual::new(&inverse(&g, 1.0), &g.targets, linear).unwrap();
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
    let residual = Residual::new(&whole, &g.targets, linear).unwrap();
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
