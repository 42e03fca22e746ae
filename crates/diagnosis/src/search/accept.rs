use std::collections::BTreeMap;

use logs::LogError;

use crate::error::DiagnosisError;
use crate::regression::fitted_model::{FittedModel, fit_model};
use crate::regression::problem::{HypothesisSet, Problem};
use crate::regression::uncertainty::find_undetermined;
use crate::search::constancy::{Variation, size_variation};
use crate::search::dataset::Dataset;
use crate::search::inputs::Inputs;
use crate::search::search_result::SearchResult;
use crate::search::select::Selection;
use crate::search::twins::{Separated, TwinDecision, Twins};

/// Most rounds in which a finding is exchanged for a better twin.
const EXCHANGES: usize = 4;

/// Effects that are excluded because their sizes would have to vary.
pub(crate) type Inconstant = BTreeMap<usize, Variation>;

/// A model whose sizes are determined and constant, and the robot with it.
#[derive(Debug)]
pub(crate) struct Accepted {
    pub model: HypothesisSet,
    pub fitted: FittedModel,
    pub inconstant: Inconstant,
}

impl Inputs<'_> {
    /// Accepts effects, and exchanges findings for their twins until no twin does better. Also returns the twins that
    /// do worse.
    pub fn accept_best_twins(
        &self,
        dataset: &Dataset,
        SearchResult { problem, model, fitted }: &SearchResult,
    ) -> Result<(Accepted, Separated), DiagnosisError> {
        let selection = dataset.selection(problem);
        let twins = Twins { inputs: self, selection: &selection };
        let (model, fitted) = (model.clone(), fitted.clone());
        let mut accepted = self.accept(&selection, model, fitted, Inconstant::new())?;
        let mut left = EXCHANGES;
        loop {
            let TwinDecision { separated, better } =
                twins.decide(&accepted.model, &accepted.fitted)?;
            let is_constant =
                |m: &HypothesisSet| !m.iter().any(|g| accepted.inconstant.contains_key(g));
            match better.filter(|better| left > 0 && is_constant(better)) {
                Some(better) => {
                    let fitted = fit_model(self.robot, &self.log, problem, &better)?;
                    accepted = self.accept(&selection, better, fitted, accepted.inconstant)?;
                }
                None => return Ok((accepted, separated)),
            }
            left -= 1;
        }
    }

    /// Removes effects whose size the data do not determine or that would have to vary. Each removed effect is
    /// replaced by a simpler special case where one qualifies.
    fn accept(
        &self,
        selection: &Selection,
        mut model: HypothesisSet,
        mut fitted: FittedModel,
        mut inconstant: Inconstant,
    ) -> Result<Accepted, DiagnosisError> {
        let problem = selection.problem;
        let fit = |model: &HypothesisSet| fit_model(self.robot, &self.log, problem, model);
        while let Some(plain) = selection.without_rare(&model) {
            model = plain;
            fitted = fit(&model)?;
        }
        loop {
            let first = self.first_fit(problem, &model, &fitted);
            let unknown = find_undetermined(problem, &model, &fitted.last_fit(first));
            if let Some(g) = unknown {
                model = selection.without(&model, g);
                fitted = fit(&model)?;
                continue;
            }
            let varying = self.find_inconstant(problem, &model, &inconstant, &fitted)?;
            if varying.is_empty() {
                return Ok(Accepted { model, fitted, inconstant });
            }
            model.retain(|g| !varying.contains_key(g));
            inconstant.extend(varying);
            fitted = fit(&model)?;
        }
    }

    /// The effects of a model whose sizes would have to vary, in a fit that includes the `inconstant` effects.
    fn find_inconstant(
        &self,
        problem: &Problem,
        model: &HypothesisSet,
        inconstant: &Inconstant,
        fitted: &FittedModel,
    ) -> Result<Inconstant, LogError> {
        let all: HypothesisSet = model.iter().chain(inconstant.keys()).copied().collect();
        if inconstant.is_empty() {
            return Ok(self.variations(problem, model, &all, fitted));
        }
        let fitted = fit_model(self.robot, &self.log, problem, &all)?;
        Ok(self.variations(problem, model, &all, &fitted))
    }

    /// How the sizes of a model's effects vary in the fit of a model with the effects `all`.
    fn variations(
        &self,
        problem: &Problem,
        model: &HypothesisSet,
        all: &HypothesisSet,
        fitted: &FittedModel,
    ) -> Inconstant {
        let last = fitted.last_fit(self.first_fit(problem, all, fitted));
        let of = |&g: &usize| {
            let group = &problem.design.groups[g];
            let size: Vec<f64> = group.columns.iter().map(|&k| fitted.weights[k]).collect();
            let own = last.problem.design.find(group.hypothesis)?;
            Some((g, size_variation(&last, own, &size)?))
        };
        model.iter().filter_map(of).collect()
    }
}
