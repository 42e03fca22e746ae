use logs::LogError;

use crate::regression::fitted_model::{FittedModel, fit_model};
use crate::regression::problem::{HypothesisSet, Problem};
use crate::search::admit::Admitted;
use crate::search::change::Change;
use crate::search::inputs::Inputs;
use crate::search::ledger::Ledger;
use crate::search::model_state::ModelState;
use crate::search::refusal::Refusal;
use crate::search::rivals::{contenders, with_rival};
use crate::search::select::Selection;

/// Twins are two effects with the same columns about the robot without them, such as a delay and a lag. They are
/// compared about the robots that have one of them.
#[derive(Debug)]
pub(crate) struct Twins<'a> {
    pub inputs: &'a Inputs<'a>,
    pub selection: &'a Selection<'a>,
}

impl Twins<'_> {
    /// Compares every finding of a fitted model with its twins. Enters the twins that do worse in the ledger, and returns
    /// the model with the best twin in place of a finding, where one does better.
    pub fn compare(
        &self,
        model: &HypothesisSet,
        fitted: &FittedModel,
        ledger: &mut Ledger,
    ) -> Result<Option<HypothesisSet>, LogError> {
        let problem = self.selection.problem;
        ledger.keep_twins_of(&HypothesisSet::new());
        let Some(state) = ModelState::new(problem, model.clone()) else { return Ok(None) };
        let here = self.deviance(model, fitted);
        let mut best: Option<Admitted> = None;
        for (g, h) in self.pairs(model) {
            let other = with_rival(problem, &Change::leave(g).rest(model), g, h);
            let fitted = fit_model(self.inputs.robot, &self.inputs.log, problem, &other)?;
            let there = self.deviance(&other, &fitted);
            match self.selection.admit(&state, &Change::twin(g, h, [here.clone(), there])) {
                Ok(next) if best.as_ref().is_none_or(|best| next.gain > best.gain) => {
                    best = Some(next);
                }
                Err(refusal @ Refusal::WorseThanTwin { .. }) => ledger.refuse(h, refusal),
                _ => {}
            }
        }
        Ok(best.map(|admitted| admitted.state.model))
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
        let block = |b: &usize| grams.deviance(*b, weight, last.weights);
        let group = |blocks: Vec<usize>| blocks.iter().map(block).sum();
        last.problem.independent().into_iter().map(group).collect()
    }
}
