use catalogue::EffectKind;
use effects::Quantity;
use nalgebra::{DMatrix, DVector};
use robot::Robot;
use statrs::distribution::{ContinuousCDF, StudentsT};

use crate::extend::extended;
use crate::fit::{Fit, covariance, pick};
use crate::problem::{Model, Problem};
use crate::result::Estimate;

/// Share of the prior's standard deviation above which a number is the prior's, not the data's.
const DETERMINED: f64 = 0.5;

/// The uncertainty of a model's weights.
///
/// Two covariances of the weights are kept, and the larger of the two counts:
///
/// ```text
/// likelihood  A^-1, where n correlated samples count as n / time
/// blocks      A^-1 (sum_b s_b s_b') A^-1 B / (B - 1),  s_b the score of block b
/// ```
#[derive(Debug, Clone)]
pub(crate) struct Uncertainty {
    columns: Vec<usize>,
    likelihood: DMatrix<f64>,
    blocks: DMatrix<f64>,
    /// Half width of a 95 per cent interval in standard deviations.
    t: f64,
}

impl Uncertainty {
    /// The uncertainty of `fit`, whose weights are used as they stand in `weights`.
    pub fn new(problem: &Problem, fit: &Fit, weights: &[f64]) -> Self {
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
        let blocks = &likelihood * meat * &likelihood * (count / (count - 1.0).max(1.0));
        let t =
            StudentsT::new(0.0, 1.0, (count - 1.0).max(1.0)).map_or(2.0, |d| d.inverse_cdf(0.975));
        Self { columns, likelihood, blocks, t }
    }

    /// The parameters of `group` as the user reads them, with intervals.
    pub fn estimates(
        &self,
        problem: &Problem,
        model: &Model,
        group: usize,
        (robot, changed, weights): (&Robot, &Robot, &[f64]),
    ) -> Vec<Estimate> {
        let design = problem.design;
        let hypothesis = design.groups[group].hypothesis;
        let at = |w: &[f64]| hypothesis.quantities(robot, &extended(robot, design, model, w));
        let here = hypothesis.quantities(robot, changed);
        let linear = at(weights);
        let own = &design.groups[group].columns;
        let slopes: Vec<Vec<f64>> =
            own.iter().map(|&k| slope(&at, &here, weights, k, design.prior[k])).collect();
        let place: Vec<usize> =
            own.iter().filter_map(|k| self.columns.iter().position(|c| c == k)).collect();
        here.iter()
            .enumerate()
            .map(|(i, quantity)| {
                let gradient = DVector::from_iterator(own.len(), slopes.iter().map(|s| s[i]));
                let prior = pick(&DVector::from_column_slice(&design.prior), own);
                let sd = self.sd(&place, &gradient);
                let before = gradient.component_mul(&prior).norm();
                let mut estimate = estimate(quantity, sd * self.t, before * self.t);
                let at = (linear[i].value, weights);
                clip(&mut estimate, (own, &gradient), &design.bounds, at);
                if hypothesis.kind == EffectKind::JointElasticity {
                    let half = self.t * self.sd(&place, &DVector::from_element(own.len(), 1.0));
                    estimate.ci95 = between(estimate.value.recip(), half);
                }
                estimate
            })
            .collect()
    }

    /// Standard deviation of `gradient' w` over the columns at `place`.
    fn sd(&self, place: &[usize], gradient: &DVector<f64>) -> f64 {
        let variance = |all: &DMatrix<f64>| {
            let part = DMatrix::from_fn(place.len(), place.len(), |i, k| all[(place[i], place[k])]);
            gradient.dot(&(part * gradient))
        };
        variance(&self.likelihood).max(variance(&self.blocks)).max(0.0).sqrt()
    }

    /// How many directions of the group's weights the data leave as wide as half the prior,
    /// and how many there are.
    pub fn undetermined(&self, problem: &Problem, group: usize) -> (usize, usize) {
        let design = problem.design;
        let own = &design.groups[group].columns;
        let place: Vec<usize> =
            own.iter().filter_map(|k| self.columns.iter().position(|c| c == k)).collect();
        let scaled = DMatrix::from_fn(place.len(), place.len(), |i, k| {
            self.likelihood[(place[i], place[k])] / (design.prior[own[i]] * design.prior[own[k]])
        });
        // An infinite covariance has no eigenvalues, and determines nothing.
        if scaled.is_empty() || scaled.iter().any(|v| !v.is_finite()) {
            return (own.len(), own.len());
        }
        let wide =
            scaled.symmetric_eigenvalues().iter().filter(|v| **v > DETERMINED.powi(2)).count();
        (wide, own.len())
    }
}

/// A hypothesis with one weight none of whose parameters differs from its nominal value by
/// more than its 95 per cent interval, if there is one: its size is not decided.
pub(crate) fn undecided(
    problem: &Problem,
    model: &Model,
    sized: (&Robot, &Robot, &[f64]),
) -> Option<usize> {
    let fit = problem.fit(model)?;
    let uncertainty = Uncertainty::new(problem, &fit, sized.2);
    let holds = |e: &Estimate| e.ci95[0] <= e.nominal && e.nominal <= e.ci95[1];
    model.iter().copied().find(|&g| {
        let single = problem.design.groups[g].columns.len() == 1;
        single && uncertainty.estimates(problem, model, g, sized).iter().all(holds)
    })
}

/// Change of every quantity per unit of weight `k`, by a central difference.
fn slope(
    at: &impl Fn(&[f64]) -> Vec<Quantity>,
    here: &[Quantity],
    weights: &[f64],
    k: usize,
    prior: f64,
) -> Vec<f64> {
    let step = 1e-4 * prior;
    let moved = |sign: f64| {
        let mut w = weights.to_vec();
        w[k] += sign * step;
        at(&w)
    };
    let (up, down) = (moved(1.0), moved(-1.0));
    let slope = |i: usize| (up[i].value - down[i].value) / (2.0 * step);
    (0..here.len()).map(slope).collect()
}

/// Keeps an interval within what is physically possible, where its quantity follows one
/// bounded weight; `value` is the quantity at `weights`.
fn clip(
    estimate: &mut Estimate,
    (own, gradient): (&[usize], &DVector<f64>),
    bounds: &[(f64, f64)],
    (value, weights): (f64, &[f64]),
) {
    let mut followed = own.iter().zip(gradient.iter()).filter(|(_, g)| g.abs() > 0.0);
    let (Some((&k, &slope)), None) = (followed.next(), followed.next()) else { return };
    let at = |bound: f64| value + slope * (bound - weights[k]);
    let (a, b) = (at(bounds[k].0), at(bounds[k].1));
    let [low, high] = estimate.ci95;
    estimate.ci95 = [low.max(a.min(b)).min(estimate.value), high.min(a.max(b)).max(estimate.value)];
}

/// Interval of the reciprocal of a number that is not negative and known to `half`: of a
/// stiffness whose compliance is what the weights change.
fn between(number: f64, half: f64) -> [f64; 2] {
    [(number + half).recip(), (number - half).max(0.0).recip()]
}

/// An estimate with the half width `half` of its interval, which was `before` without data.
/// A quantity that no weight moves is not determined.
fn estimate(quantity: &Quantity, half: f64, before: f64) -> Estimate {
    Estimate {
        name: quantity.name,
        value: quantity.value,
        ci95: [quantity.value - half, quantity.value + half],
        nominal: quantity.nominal,
        unit: quantity.unit,
        determined: before > 1e-9 * quantity.value.abs() && half < DETERMINED * before,
    }
}
