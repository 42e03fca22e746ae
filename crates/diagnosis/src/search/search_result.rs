use logs::LogError;
use robot::Robot;

use crate::error::DiagnosisError;
use crate::regression::fitted_model::{FittedModel, fit_model};
use crate::regression::problem::{HypothesisSet, Problem};
use crate::search::dataset::Dataset;
use crate::search::inputs::Inputs;
use crate::search::select_model::Selected;
use crate::search::start::Start;

/// The model that a search selects, before any test.
pub(crate) struct SearchResult<'a> {
    pub problem: Problem<'a>,
    pub model: HypothesisSet,
    pub fitted: FittedModel,
}

impl Inputs<'_> {
    /// The robot with the model of a search over all blocks, from the described robot.
    pub fn extended_robot(&self) -> Result<Robot, DiagnosisError> {
        self.with_dataset(|dataset| {
            let all: Vec<usize> = (0..dataset.blocks.len()).collect();
            let selected = dataset.select_from(&all, Start::Described.model(dataset.design));
            Ok(self.fit_selected(selected)?.fitted.robot)
        })?
    }

    /// Searches on the blocks `of`, from three starts.
    pub fn search<'b>(
        &self,
        dataset: &Dataset<'b>,
        of: &[usize],
    ) -> Result<SearchResult<'b>, LogError> {
        self.fit_selected(dataset.select_model(of))
    }

    fn fit_selected<'b>(
        &self,
        Selected { problem, model }: Selected<'b>,
    ) -> Result<SearchResult<'b>, LogError> {
        let fitted = fit_model(self.robot, &self.log, &problem, &model)?;
        Ok(SearchResult { problem, model, fitted })
    }
}
