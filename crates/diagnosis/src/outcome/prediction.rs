use std::collections::BTreeSet;

use logs::LogError;
use rayon::prelude::*;
use robot::Robot;

use crate::error::DiagnosisError;
use crate::outcome::gain::HeldOutGain;
use crate::progress::DiagnosisProgress;
use crate::regression::blocks::Fold;
use crate::regression::fitted_model::{FittedModel, fit_model};
use crate::regression::problem::{HypothesisSet, Problem};
use crate::search::causes::Causes;
use crate::search::dataset::Dataset;
use crate::search::inputs::Inputs;
use crate::search::kept_nominal::{KeptNominal, joints_predicted_worse};
use crate::search::ledger::Ledger;
use crate::search::search_result::SearchResult;

impl Inputs<'_> {
    /// Keeps the causes that predict held-out efforts better than the description, and measures by how much. A joint
    /// without such causes keeps its description.
    pub fn keep_what_predicts<'b>(
        &self,
        dataset: &Dataset<'b>,
        by_run: &Problem<'b>,
        mut causes: Causes<'b>,
        progress: &dyn DiagnosisProgress,
    ) -> Result<(Causes<'b>, HeldOutGain), DiagnosisError> {
        progress.stage("testing on held-out data", by_run.folds.len());
        let search = |fold: &Fold| {
            let found = self.search(dataset, &fold.train);
            progress.step();
            found
        };
        let by_fold: Vec<SearchResult> =
            by_run.folds.par_iter().map(search).collect::<Result<_, LogError>>()?;
        let gain = |kept_nominal: &KeptNominal, doubted: &BTreeSet<usize>| {
            let exclusions = Exclusions { ledger: &causes.ledger, kept_nominal, doubted };
            self.gain_without(exclusions, dataset, by_run, &by_fold)
        };
        let mut kept_nominal = KeptNominal::default();
        let mut best = gain(&kept_nominal, &BTreeSet::new())?;
        let doubted: BTreeSet<usize> = joints_predicted_worse(&best.inverse).collect();
        if !doubted.is_empty() {
            best = gain(&kept_nominal, &doubted)?;
        }
        while let Some(more) = kept_nominal.with_worse_joints(&best.inverse) {
            (best, kept_nominal) = (gain(&more, &doubted)?, more);
        }
        let model = kept_nominal.remaining(&causes.problem, &causes.model);
        kept_nominal.dropped = causes.model.difference(&model).copied().collect();
        if model != causes.model {
            let problem = &causes.problem;
            causes.fitted = fit_model(self.robot, &self.log, problem, &model)?;
        }
        Ok((Causes { model, kept_nominal, ..causes }, best))
    }

    /// The gain of the searches without each fold, with some of their effects excluded.
    fn gain_without(
        &self,
        exclusions: Exclusions,
        dataset: &Dataset,
        by_run: &Problem,
        by_fold: &[SearchResult],
    ) -> Result<HeldOutGain, LogError> {
        let fit = |found: &SearchResult| self.fit_without(exclusions, dataset, found);
        let folds = by_fold.par_iter().map(fit).collect::<Result<_, LogError>>()?;
        Ok(HeldOutGain::new(dataset, by_run, folds))
    }

    /// Fits the model of a search without the excluded effects. Each of these is replaced by a special case where one
    /// qualifies.
    fn fit_without(
        &self,
        exclusions: Exclusions,
        dataset: &Dataset,
        SearchResult { problem, model, fitted }: &SearchResult,
    ) -> Result<FittedModel, LogError> {
        let mut remaining = exclusions.remaining(problem, model);
        let mut fitted = if remaining == *model {
            fitted.clone()
        } else {
            fit_model(self.robot, &self.log, problem, &remaining)?
        };
        while let Some(g) = exclusions.unsound(problem, &remaining, &fitted.robot) {
            let smaller = dataset.selection(problem).without(&remaining, g);
            remaining = exclusions.remaining(problem, &smaller);
            fitted = fit_model(self.robot, &self.log, problem, &remaining)?;
        }
        Ok(fitted)
    }
}

/// Effects that a fold may find but that take no part in its prediction.
#[derive(Clone, Copy)]
struct Exclusions<'a> {
    /// Effects whose sizes would have to vary over all blocks.
    ledger: &'a Ledger,
    kept_nominal: &'a KeptNominal,
    /// Joints at which the unrestricted searches predict worse than the description.
    doubted: &'a BTreeSet<usize>,
}

impl Exclusions<'_> {
    /// A model without the excluded effects.
    fn remaining(self, problem: &Problem, model: &HypothesisSet) -> HypothesisSet {
        let mut remaining = self.kept_nominal.remaining(problem, model);
        remaining.retain(|g| !self.ledger.varies(*g));
        remaining
    }

    /// An effect at a doubted joint that is not sound about the fitted robot. An example is presliding over a way
    /// that the encoder does not resolve, whose damping may have any size.
    fn unsound(self, problem: &Problem, model: &HypothesisSet, robot: &Robot) -> Option<usize> {
        model.iter().copied().find(|&g| {
            let group = &problem.design.groups[g];
            group.joints.iter().any(|j| self.doubted.contains(j))
                && !group.hypothesis.is_sound(robot, &problem.thresholds.priors)
        })
    }
}
