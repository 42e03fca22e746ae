use std::collections::BTreeMap;

use nalgebra::{Cholesky, DMatrix};

use crate::problem::{Model, Problem};

/// How many times wider the weights of a model are known when every effect that has no name may still be
/// there, by column.
///
/// ```text
/// A = [H_mm + P^-2, H_mu; H_um, H_uu + T^-2],   factor_k = sqrt((A^-1)_kk / ((H_mm + P^-2)^-1)_kk)
/// T_k = min_j u_j / RMS_j(x_k),                 u_j = max(practical_j, left_j / sqrt(m_j))
/// ```
///
/// with `m` the columns of the model, `u` the `m_j` others that reach joint `j`, `left_j` the RMS error of held-out
/// efforts there, and `practical_j` the size below which an effect is no finding. What has no name is not
/// known to be none: each may have a torque of that RMS, and what all of them leave is as large as what is left.
pub(crate) fn widening(
    problem: &Problem,
    model: &Model,
    practical: &[f64],
) -> BTreeMap<usize, f64> {
    let own = problem.columns(model);
    let narrow = problem.fit(model).map(|_| spreads(problem, &own, &[]));
    let unnamed = unnamed(problem, model, &own, practical);
    let wide = spreads(problem, &own, &unnamed);
    let factor = |(wide, narrow): (f64, f64)| (wide / narrow).max(1.0).sqrt();
    let Some(narrow) = narrow.filter(|n| n.len() == own.len() && wide.len() == own.len()) else {
        return BTreeMap::new();
    };
    own.into_iter().zip(wide.into_iter().zip(narrow).map(factor)).collect()
}

/// The columns that no name of a model has, each with the standard deviation of its weight.
fn unnamed(
    problem: &Problem,
    model: &Model,
    own: &[usize],
    practical: &[f64],
) -> Vec<(usize, f64)> {
    let design = problem.design;
    let held_out = problem.held_out(model).mean_square;
    let mut spread: BTreeMap<usize, f64> = BTreeMap::new();
    for j in (0..design.joints()).filter(|j| problem.weight[*j] > 0.0) {
        let gram = problem.grams.joint(j, &problem.of);
        let rms = |place: usize| (gram.xx[(place, place)] / gram.count.max(1) as f64).sqrt();
        let others = || {
            let all = design.local[j].iter().copied().enumerate();
            all.filter(|(place, k)| own.binary_search(k).is_err() && rms(*place) > 0.0)
        };
        let torque = practical[j].max((held_out[j] / others().count().max(1) as f64).sqrt());
        for (place, k) in others() {
            let here = (torque / rms(place)).min(design.prior[k]);
            spread.entry(k).and_modify(|least| *least = least.min(here)).or_insert(here);
        }
    }
    spread.into_iter().filter(|(_, sd)| *sd > 0.0 && sd.is_finite()).collect()
}

/// Variances of the weights of some columns, where others are known to a standard deviation each.
fn spreads(problem: &Problem, own: &[usize], others: &[(usize, f64)]) -> Vec<f64> {
    let sd = |k: usize| problem.design.prior[k];
    let all: Vec<(usize, f64)> =
        own.iter().map(|&k| (k, sd(k))).chain(others.iter().copied()).collect();
    // In units of the spreads, which makes every diagonal at least one.
    let a = DMatrix::from_fn(all.len(), all.len(), |i, k| {
        let one = if i == k { 1.0 } else { 0.0 };
        all[i].1 * problem.info.h[(all[i].0, all[k].0)] * all[k].1 + one
    });
    let Some(factor) = Cholesky::new(a) else { return Vec::new() };
    let inverse = factor.inverse();
    (0..own.len()).map(|i| inverse[(i, i)] * all[i].1.powi(2)).collect()
}
