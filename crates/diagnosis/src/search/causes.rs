use crate::error::DiagnosisError;
use crate::progress::DiagnosisProgress;
use crate::regression::fitted_model::FittedModel;
use crate::regression::problem::{HypothesisSet, Problem};
use crate::search::accept::Accepted;
use crate::search::dataset::Dataset;
use crate::search::inputs::Inputs;
use crate::search::kept_nominal::KeptNominal;
use crate::search::ledger::Ledger;

/// The causes that a search over all blocks accepts.
pub(crate) struct Causes<'a> {
    pub problem: Problem<'a>,
    pub model: HypothesisSet,
    pub fitted: FittedModel,
    pub ledger: Ledger,
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
        let Accepted { model, fitted, ledger } = self.accept_best_twins(dataset, &found)?;
        progress.step();
        let (problem, kept_nominal) = (found.problem, KeptNominal::default());
        Ok(Causes { problem, model, fitted, ledger, kept_nominal })
    }
}
