use crate::error::DiagnosisError;
use crate::progress::DiagnosisProgress;
use crate::regression::fitted_model::FittedModel;
use crate::regression::problem::{HypothesisSet, Problem};
use crate::search::accept::{Accepted, Inconstant};
use crate::search::dataset::Dataset;
use crate::search::inputs::Inputs;
use crate::search::kept_nominal::KeptNominal;
use crate::search::twins::Separated;

/// The causes that a search over all blocks accepts.
pub(crate) struct Causes<'a> {
    pub problem: Problem<'a>,
    pub model: HypothesisSet,
    pub fitted: FittedModel,
    pub separated: Separated,
    pub inconstant: Inconstant,
    pub kept_nominal: KeptNominal,
}

impl Inputs<'_> {
    /// Searches over all blocks, and accepts causes whose size is determined and constant.
    pub fn find_causes<'b>(
        &self,
        dataset: &Dataset<'b>,
        progress: &dyn DiagnosisProgress,
    ) -> Result<Causes<'b>, DiagnosisError> {
        let all: Vec<usize> = (0..dataset.blocks.len()).collect();
        let found = self.search(dataset, &all)?;
        progress.step();
        let (accepted, separated) = self.accept_best_twins(dataset, &found)?;
        let Accepted { model, fitted, inconstant } = accepted;
        progress.step();
        let (problem, kept_nominal) = (found.problem, KeptNominal::default());
        Ok(Causes { problem, model, fitted, separated, inconstant, kept_nominal })
    }
}
