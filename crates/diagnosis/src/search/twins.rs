use std::collections::BTreeSet;

use logs::LogError;

use crate::regression::fitted_model::{FittedModel, fit_model};
use crate::regression::problem::{HypothesisSet, Problem};
use crate::search::inputs::Inputs;
use crate::search::paired_difference::PairedDifference;
use crate::search::rivals::{contenders, with_rival};
use crate::search::select::Selection;

/// Twins are two effects with the same columns about the robot without them, such as a delay and a lag. They are
/// compared about the robots that have one of them.
#[derive(Debug)]
pub(crate) struct Twins<'a> {
    pub inputs: &'a Inputs<'a>,
    pub selection: &'a Selection<'a>,
}

/// Findings, each with a twin that does worse in its place.
pub(crate) type Separated = BTreeSet<(usize, usize)>;

/// The result of comparing all findings with their twins.
#[derive(Debug, Default)]
pub(crate) struct TwinDecision {
    pub separated: Separated,
    /// The model with the best twin in place of a finding, where it does better.
    pub better: Option<HypothesisSet>,
}

impl Twins<'_> {
    /// Compares every finding of a fitted model with its twins.
    pub fn decide(
        &self,
        model: &HypothesisSet,
        fitted: &FittedModel,
    ) -> Result<TwinDecision, LogError> {
        let problem = self.selection.problem;
        let errors = problem.thresholds.search.rival_errors;
        let here = self.deviance(model, fitted);
        let mut decision = TwinDecision::default();
        let mut best = 0.0;
        for (g, h) in self.pairs(model) {
            let mut without = model.clone();
            without.remove(&g);
            let other = with_rival(problem, &without, g, h);
            let fitted = fit_model(self.inputs.robot, &self.inputs.log, problem, &other)?;
            let there = self.deviance(&other, &fitted);
            let difference = PairedDifference::new(here.iter().copied().zip(there));
            if difference.exceeds(errors) {
                decision.separated.insert((g, h));
            } else if difference.total < best {
                best = difference.total;
                decision.better = Some(other);
            }
        }
        Ok(decision)
    }

    /// Findings and their twins.
    fn pairs(&self, model: &HypothesisSet) -> Vec<(usize, usize)> {
        let hypothesis = |g: usize| self.selection.problem.design.groups[g].hypothesis;
        let of = |&g: &usize| {
            let is_twin = |h: usize| hypothesis(h).is_twin(hypothesis(g));
            contenders(self.selection, model, g, is_twin).into_iter().map(move |(h, _)| (g, h))
        };
        model.iter().flat_map(of).collect()
    }

    /// Weighted sum of squares of a fitted model on every independent group of blocks.
    fn deviance(&self, model: &HypothesisSet, fitted: &FittedModel) -> Vec<f64> {
        let first = self.inputs.first_fit(self.selection.problem, model, fitted);
        let last = fitted.last_fit(first);
        let Problem { grams, weight, .. } = &*last.problem;
        let joint = |j: usize, b: usize| weight[j] * grams.remaining(j, &[b], last.weights).0;
        let block = |b: &usize| (0..weight.len()).map(|j| joint(j, *b)).sum::<f64>();
        let group = |blocks: Vec<usize>| blocks.iter().map(block).sum();
        last.problem.independent().into_iter().map(group).collect()
    }
}
