use catalogue::Family;
use effects::Hypothesis;
use logs::LogError;

use crate::error::DiagnosisError;
use crate::regression::fitted_model::{FittedModel, fit_model};
use crate::regression::problem::HypothesisSet;
use crate::search::change::Change;
use crate::search::dataset::Dataset;
use crate::search::inputs::Inputs;
use crate::search::ledger::Ledger;
use crate::search::model_state::{LastFit, ModelState, SizeQuestion};
use crate::search::refusal::Refusal;
use crate::search::search_result::SearchResult;
use crate::search::select::Selection;
use crate::search::twins::Twins;

/// Most rounds in which a finding is exchanged for a better twin, or another enters.
const EXCHANGES: usize = 4;

/// A model whose sizes are determined and constant, the robot with it, and what left.
#[derive(Debug)]
pub(crate) struct Accepted {
    pub model: HypothesisSet,
    pub fitted: FittedModel,
    pub ledger: Ledger,
}

impl Inputs<'_> {
    /// Takes changes that are admitted about the last fit until there is none, exchanges findings for their twins until no
    /// twin does better, and lets in what is admitted beside what stayed.
    pub fn accept_best_twins(
        &self,
        dataset: &Dataset,
        SearchResult { problem, model, fitted }: &SearchResult,
    ) -> Result<Accepted, DiagnosisError> {
        let selection = dataset.selection(problem);
        let twins = Twins { inputs: self, selection: &selection };
        let (mut left, mut tried) = (EXCHANGES, model.clone());
        let (model, fitted) = (model.clone(), fitted.clone());
        let mut accepted =
            self.accept(&selection, Accepted { model, fitted, ledger: Ledger::default() })?;
        loop {
            let Accepted { model, fitted, ledger } = &mut accepted;
            let better = twins.compare(model, fitted, ledger)?;
            let better = better.filter(|m| !ledger.refuses_any(m));
            let next = better.or_else(|| entry_beside(&selection, model, ledger, &tried));
            let Some(model) = next.filter(|_| left > 0) else { return Ok(accepted) };
            tried.extend(&model);
            let fitted = fit_model(self.robot, &self.log, problem, &model)?;
            accepted = self.accept(&selection, Accepted { model, fitted, ..accepted })?;
            left -= 1;
        }
    }

    /// Removes effects whose size the data do not determine or that would have to vary. What is not determined is
    /// replaced by a simpler special case where one is admitted.
    fn accept(
        &self,
        selection: &Selection,
        Accepted { mut model, mut fitted, mut ledger }: Accepted,
    ) -> Result<Accepted, DiagnosisError> {
        loop {
            if let Some(next) = self.with_known_sizes(selection, &model, &fitted) {
                model = next;
            } else {
                let varying = self.find_varying(selection, &model, &fitted, &ledger)?;
                if varying.is_empty() {
                    return Ok(Accepted { model, fitted, ledger });
                }
                for (g, refusal) in varying {
                    model.remove(&g);
                    ledger.refuse(g, refusal);
                }
            }
            fitted = fit_model(self.robot, &self.log, selection.problem, &model)?;
        }
    }

    /// The model after one change: a hypothesis of few arms is simplified, or else one whose size is not determined
    /// leaves.
    fn with_known_sizes(
        &self,
        selection: &Selection,
        model: &HypothesisSet,
        fitted: &FittedModel,
    ) -> Option<HypothesisSet> {
        let state = self.state(selection, model, fitted, SizeQuestion::Sizes)?;
        let simpler = |&g: &usize| selection.admit(&state, &selection.simplification(g)).ok();
        if let Some(admitted) = model.iter().find_map(simpler) {
            return Some(admitted.state.model);
        }
        let leaves = |g: &&usize| selection.admit(&state, &Change::leave(**g)).is_ok();
        model.iter().find(leaves).map(|&g| selection.without(model, g))
    }

    /// The effects of a model whose sizes would have to vary, in a fit that includes those of the ledger that do.
    fn find_varying(
        &self,
        selection: &Selection,
        model: &HypothesisSet,
        fitted: &FittedModel,
        ledger: &Ledger,
    ) -> Result<Vec<(usize, Refusal)>, LogError> {
        let all: HypothesisSet = model.iter().copied().chain(ledger.varying()).collect();
        let whole = match all == *model {
            true => None,
            false => Some(fit_model(self.robot, &self.log, selection.problem, &all)?),
        };
        let fitted = whole.as_ref().unwrap_or(fitted);
        let Some(state) = self.state(selection, &all, fitted, SizeQuestion::Constancy) else {
            return Ok(Vec::new());
        };
        let refusal = |&g: &usize| {
            let admitted = selection.admit(&state, &Change::leave(g)).ok()?;
            admitted.because.map(|because| (g, because))
        };
        Ok(model.iter().filter_map(refusal).collect())
    }

    /// A model with its last fit.
    pub fn state<'b>(
        &'b self,
        selection: &'b Selection<'b>,
        model: &'b HypothesisSet,
        fitted: &'b FittedModel,
        question: SizeQuestion,
    ) -> Option<ModelState<'b>> {
        let first = self.first_fit(selection.problem, model, fitted);
        let last = LastFit::new(fitted.last_fit(first), &fitted.weights, question);
        ModelState::new(selection.problem, model.clone()).map(|state| state.about(last))
    }
}

/// A model with friction that enters it, beside what left because its size would have to vary. What was refused, or was `tried`,
/// may not enter, nor may other causes: a spring or a body can be what left by another name.
fn entry_beside(
    selection: &Selection,
    model: &HypothesisSet,
    ledger: &Ledger,
    tried: &HypothesisSet,
) -> Option<HypothesisSet> {
    let groups = selection.problem.design.groups.iter().enumerate();
    let is_friction = |h: Hypothesis| h.kind.entry().family == Family::Friction && !h.is_imitable();
    let others = groups.filter(|(_, group)| !is_friction(group.hypothesis)).map(|(g, _)| g);
    let barred = ledger.hypotheses().chain(tried.iter().copied()).chain(others).collect();
    let selection = Selection { barred, ..selection.clone() };
    let varying: HypothesisSet = ledger.varying().collect();
    let whole = model.union(&varying).copied().collect();
    let larger = selection.best_entry(&ModelState::new(selection.problem, whole)?)?.model;
    Some(larger.difference(&varying).copied().collect())
}
