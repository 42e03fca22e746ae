use nalgebra::{Cholesky, DVector};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::problem::{Model, Problem};

/// Probability, were `group` no part of the truth, of seeing at least what is seen.
///
/// A sign-flip test of the effective score. Under the model without the group each block
/// contributes to the group's weights
///
/// ```text
/// nu_b = X_K' C r_b - A_KS A_SS^-1 X_S' C r_b,   S(signs) = |B^-1/2 sum_b signs_b nu_b|^2
/// p = (1 + #{random signs: S(signs) >= S(all +)}) / (1 + number of random signs)
/// ```
///
/// If the group is idle the contributions of separate blocks are as likely positive as
/// negative, whatever the spectrum and the variance of the noise within a block: the
/// flipped residual is a surrogate of the noise with its own autocorrelation kept. Blocks of
/// runs that repeat a motion are flipped together.
/// None when the group has no column of its own.
///
/// # Source
///
/// Hemerik, Goeman & Finos, *Robust testing in generalized linear models by sign flipping
/// score contributions*, J. R. Stat. Soc. B 82, 2020; blocks as in Cameron, Gelbach &
/// Miller 2008.
pub(crate) fn p_value(
    problem: &Problem,
    model: &Model,
    group: usize,
    flips: usize,
    seed: u64,
) -> Option<f64> {
    let mut without = model.clone();
    without.remove(&group);
    let columns = problem.new_columns(&without, group);
    if columns.is_empty() {
        return None;
    }
    let fit = problem.fit(&without)?;
    let complement = fit.complement(&problem.info, &columns, &problem.design.prior);
    let root = Cholesky::new(complement.b.clone())?.l();
    let weights = fit.expand(problem.design.width);
    let scores = problem.scores(&weights);
    let effective = |score| root.solve_lower_triangular(&complement.project(score));
    let contributions: Vec<DVector<f64>> = scores.iter().filter_map(effective).collect();
    let statistic = |signs: &mut dyn FnMut() -> f64| {
        let mut sum = DVector::zeros(columns.len());
        contributions.iter().for_each(|nu| sum.axpy(signs(), nu, 1.0));
        sum.norm_squared()
    };
    let seen = statistic(&mut || 1.0);
    // Every group draws its own signs: tests of different groups share no luck.
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    rng.set_stream(group as u64);
    let as_large = (0..flips)
        .filter(|_| {
            let flipped = statistic(&mut || if rng.random_bool(0.5) { 1.0 } else { -1.0 });
            // Equal signs give the seen value again, up to rounding.
            flipped >= seen * (1.0 - 1e-9)
        })
        .count();
    Some((1 + as_large) as f64 / (1 + flips) as f64)
}

/// The false-discovery rate at which each test would just be reported.
///
/// ```text
/// q_(i) = min_{k >= i} p_(k) m / k
/// ```
///
/// # Source
///
/// Benjamini & Hochberg 1995.
pub(crate) fn q_values(p: &[f64]) -> Vec<f64> {
    let mut order: Vec<usize> = (0..p.len()).collect();
    order.sort_by(|&a, &b| p[a].total_cmp(&p[b]));
    let mut q = vec![1.0; p.len()];
    let mut least: f64 = 1.0;
    for (rank, &i) in order.iter().enumerate().rev() {
        least = least.min(p[i] * p.len() as f64 / (rank + 1) as f64);
        q[i] = least;
    }
    q
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn q_values_agree_with_the_worked_example() {
        // statsmodels 0.14 multipletests(p, method="fdr_bh").
        let q = q_values(&[0.01, 0.04, 0.03, 0.005]);
        let expected = [0.02, 0.04, 0.04, 0.02];
        q.iter().zip(expected).for_each(|(a, b)| assert!((a - b).abs() < 1e-12, "{q:?}"));
    }
}
