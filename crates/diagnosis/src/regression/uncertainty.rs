use effects::{EffectQuantity, Hypothesis, Weights};
use nalgebra::{DMatrix, DVector};
use statrs::distribution::{ChiSquared, ContinuousCDF, StudentsT};

use crate::columns::common::CommonPart;
use crate::regression::extend_robot::extend_robot;
use crate::regression::fit::{Fit, covariance, pick};
use crate::regression::linear_fit::LinearFit;
use crate::regression::problem::Problem;
use crate::result::Estimate;
use crate::thresholds::sizes::SizeThresholds;

/// Share of the largest eigenvalue of a correlation matrix below which an eigenvalue counts as rounding.
const ROUNDING: f64 = 1e-10;

/// The uncertainty of a model's weights.
///
/// Two covariances of the weights are kept, and the larger of the two counts:
///
/// ```text
/// likelihood  A^-1, where n correlated samples count as n / time
/// blocks      A^-1 (sum_b s_b s_b') A^-1 B / (B - 1),  s_b the score of block b
/// ```
///
/// Both are of the noise. The uncertainty from unnamed effects is added where it is known.
#[derive(Debug, Clone)]
pub(crate) struct Uncertainty {
    columns: Vec<usize>,
    likelihood: DMatrix<f64>,
    blocks: DMatrix<f64>,
    /// Covariance from unnamed effects.
    unnamed: DMatrix<f64>,
    thresholds: SizeThresholds,
    /// Half width of a 95 per cent interval in standard deviations.
    t: f64,
}

impl Uncertainty {
    /// The uncertainty of the weights of a linear fit.
    pub fn of(fitted: &LinearFit) -> Option<Self> {
        let fit = fitted.problem.fit(fitted.model)?;
        Some(Self::new(&fitted.problem, &fit, fitted.weights))
    }

    /// The same, with the covariance from unnamed effects added to its columns.
    pub fn with_unnamed_effects(mut self, of: impl FnOnce(&[usize]) -> DMatrix<f64>) -> Self {
        self.unnamed = of(&self.columns);
        self
    }

    /// The uncertainty of `fit`, whose weights have the final values `weights`.
    fn new(problem: &Problem, fit: &Fit, weights: &[f64]) -> Self {
        // Weights held at a bound are uncertain too, on the side that is possible.
        let held = fit.held.iter().map(|(k, _)| *k);
        let mut columns: Vec<usize> = fit.columns.iter().copied().chain(held).collect();
        columns.sort_unstable();
        let likelihood = covariance(&problem.info, &columns, &problem.design.prior);
        let scores = problem.scores(weights);
        let count = scores.len() as f64;
        let mut meat = DMatrix::zeros(columns.len(), columns.len());
        for score in &scores {
            let own = pick(score, &columns);
            meat.ger(1.0, &own, &own, 1.0);
        }
        if let Some(CommonPart { columns: common, of_others }) = &problem.design.common {
            let place = |k: &usize| common.contains(k).then(|| *k - common.start);
            let places: Vec<Option<usize>> = columns.iter().map(place).collect();
            meat += DMatrix::from_fn(columns.len(), columns.len(), |i, k| {
                places[i].zip(places[k]).map_or(0.0, |at| of_others.scores[at])
            });
        }
        let blocks = &likelihood * meat * &likelihood * (count / (count - 1.0).max(1.0));
        let thresholds = problem.thresholds.sizes.clone();
        let quantile = thresholds.interval_quantile;
        let t = StudentsT::new(0.0, 1.0, (count - 1.0).max(1.0))
            .map_or(2.0, |d| d.inverse_cdf(quantile));
        let unnamed = DMatrix::zeros(columns.len(), columns.len());
        Self { columns, likelihood, blocks, unnamed, thresholds, t }
    }

    /// The parameters of `hypothesis` with intervals, as the user reads them, where the hypothesis and its `parts`
    /// are fitted about a robot.
    pub fn estimates(
        &self,
        fitted: &LinearFit,
        hypothesis: Hypothesis,
        parts: &[Hypothesis],
    ) -> Vec<Estimate> {
        let (design, weights) = (fitted.problem.design, fitted.weights);
        let at = |w: &[f64]| {
            let robot = extend_robot(fitted.about, design, fitted.model, w);
            hypothesis.quantities(fitted.nominal, &robot)
        };
        let here = at(weights);
        let groups = parts.iter().chain([&hypothesis]).filter_map(|h| design.find(*h));
        let own: Vec<usize> =
            groups.flat_map(|g| design.groups[g].columns.iter().copied()).collect();
        let slopes: Vec<Vec<f64>> =
            own.iter().map(|&k| slope(&at, &here, weights, k, design.prior[k])).collect();
        let place: Vec<usize> =
            own.iter().filter_map(|k| self.columns.iter().position(|c| c == k)).collect();
        let is_reciprocal = hypothesis.traits().is_some_and(|n| n.weights == Weights::Reciprocal);
        let estimate = |(i, quantity): (usize, &EffectQuantity)| {
            let gradient = DVector::from_iterator(own.len(), slopes.iter().map(|s| s[i]));
            let interval = |with: f64| match is_reciprocal {
                true => {
                    let only = DVector::from_fn(own.len(), |k, _| f64::from(u8::from(k == i)));
                    reciprocal_interval(quantity.value.recip(), self.half(&place, &only, with))
                }
                false => {
                    let half = self.half(&place, &gradient, with);
                    let whole = [quantity.value - half, quantity.value + half];
                    let at = (quantity.value, weights);
                    clip_interval(whole, (&own, &gradient), &design.bounds, at)
                }
            };
            let prior = pick(&DVector::from_column_slice(&design.prior), &own);
            let before = self.t * gradient.component_mul(&prior).norm();
            let half = self.half(&place, &gradient, 1.0);
            Estimate {
                name: quantity.name,
                value: quantity.value,
                ci95: interval(1.0),
                noise95: interval(0.0),
                nominal: quantity.nominal,
                unit: quantity.unit,
                // A quantity that no weight moves is not determined.
                determined: before > self.thresholds.rounding * quantity.value.abs()
                    && half < self.thresholds.determined * before,
            }
        };
        here.iter().enumerate().map(estimate).collect()
    }

    /// Half the 95 per cent interval of `gradient' w` over the columns at `place`, with a share of the covariance
    /// from unnamed effects.
    fn half(&self, place: &[usize], gradient: &DVector<f64>, share: f64) -> f64 {
        let variance = |all: &DMatrix<f64>| {
            let part = DMatrix::from_fn(place.len(), place.len(), |i, k| all[(place[i], place[k])]);
            gradient.dot(&(part * gradient))
        };
        let noise = variance(&self.likelihood).max(variance(&self.blocks));
        self.t * (noise + share * variance(&self.unnamed)).max(0.0).sqrt()
    }

    /// How far a change of the weights of some columns is from none, and the limit of their 95 per cent region:
    ///
    /// ```text
    /// chi2 = change' C^-1 change / max(1, trace(C^-1 C_blocks) / k),  limit = chi^2_k(0.95)
    /// ```
    ///
    /// with `C` of the likelihood and `k` columns. `None` where a covariance is not finite.
    pub fn chi2_and_limit(&self, columns: &[usize], change: &DVector<f64>) -> Option<[f64; 2]> {
        let place: Vec<usize> =
            columns.iter().filter_map(|k| self.columns.iter().position(|c| c == k)).collect();
        let sd = |i: usize| self.likelihood[(place[i], place[i])].sqrt();
        let part = |all: &DMatrix<f64>| {
            let over_sd = |i, k| all[(place[i], place[k])] / (sd(i) * sd(k));
            DMatrix::from_fn(place.len(), place.len(), over_sd)
        };
        let (likelihood, count) = (part(&self.likelihood), place.len());
        if count != change.len() || likelihood.iter().any(|v| !v.is_finite()) {
            return None;
        }
        let scaled = DVector::from_fn(count, |i, _| change[i] / sd(i));
        let inverse = likelihood.pseudo_inverse(ROUNDING).ok()?;
        let law = ChiSquared::new(count as f64).ok()?;
        let wider = ((&inverse * part(&self.blocks)).trace() / count as f64).max(1.0);
        let chi2 = scaled.dot(&(&inverse * &scaled)) / wider;
        Some([chi2, law.inverse_cdf(self.thresholds.region)])
    }

    /// Number of directions of a group's weights whose standard deviation is more than half that of the prior, and
    /// the number of all its directions.
    pub fn undetermined_directions(
        &self,
        problem: &Problem,
        hypothesis: Hypothesis,
    ) -> (usize, usize) {
        let design = problem.design;
        let Some(group) = design.find(hypothesis) else { return (0, 0) };
        let own = &design.groups[group].columns;
        let place: Vec<usize> =
            own.iter().filter_map(|k| self.columns.iter().position(|c| c == k)).collect();
        let scaled = DMatrix::from_fn(place.len(), place.len(), |i, k| {
            self.likelihood[(place[i], place[k])] / (design.prior[own[i]] * design.prior[own[k]])
        });
        // A covariance that is infinite has no eigenvalues: nothing is determined.
        if scaled.is_empty() || scaled.iter().any(|v| !v.is_finite()) {
            return (own.len(), own.len());
        }
        let widest = self.thresholds.determined.powi(2);
        let wide = scaled.symmetric_eigenvalues().iter().filter(|v| **v > widest).count();
        (wide, own.len())
    }
}

/// Change of every quantity per unit of weight `k`, by a central difference.
fn slope(
    at: &impl Fn(&[f64]) -> Vec<EffectQuantity>,
    here: &[EffectQuantity],
    weights: &[f64],
    k: usize,
    prior: f64,
) -> Vec<f64> {
    let step = 1e-4 * prior;
    let at_step = |sign: f64| {
        let mut w = weights.to_vec();
        w[k] += sign * step;
        at(&w)
    };
    let (up, down) = (at_step(1.0), at_step(-1.0));
    let slope = |i: usize| (up[i].value - down[i].value) / (2.0 * step);
    (0..here.len()).map(slope).collect()
}

/// An interval clipped to what is physically possible, where its quantity follows one bounded weight. `value` is the
/// quantity at `weights`.
fn clip_interval(
    [low, high]: [f64; 2],
    (own, gradient): (&[usize], &DVector<f64>),
    bounds: &[(f64, f64)],
    (value, weights): (f64, &[f64]),
) -> [f64; 2] {
    let mut followed = own.iter().zip(gradient.iter()).filter(|(_, g)| g.abs() > 0.0);
    let (Some((&k, &slope)), None) = (followed.next(), followed.next()) else {
        return [low, high];
    };
    let at = |bound: f64| value + slope * (bound - weights[k]);
    let (a, b) = (at(bounds[k].0), at(bounds[k].1));
    [low.max(a.min(b)).min(value), high.min(a.max(b)).max(value)]
}

/// Interval of the reciprocal of a non-negative number that is known to within `half`, such as a stiffness whose
/// weight is a compliance.
fn reciprocal_interval(number: f64, half: f64) -> [f64; 2] {
    [(number + half).recip(), (number - half).max(0.0).recip()]
}
