use nalgebra::DMatrix;

use crate::columns::common::Common;
use crate::error::DiagnosisError;
use crate::regression::problem::HypothesisSet;
use crate::search::inputs::Inputs;

impl Inputs<'_> {
    /// What these logs say of the weights of all hypotheses together, for others that have them in common; `None` where
    /// they cannot be fitted.
    pub fn common(&self) -> Result<Option<Common>, DiagnosisError> {
        self.with_dataset(|dataset| {
            let all: Vec<usize> = (0..dataset.blocks.len()).collect();
            let problem = dataset.problem(&all);
            let design = self.design;
            let model: HypothesisSet = (0..design.groups.len()).collect();
            let weights = problem.fit(&model)?.expand(design.width);
            let mut scores = DMatrix::zeros(design.width, design.width);
            for score in problem.scores(&weights) {
                scores.ger(1.0, &score, &score, 1.0);
            }
            let info = problem.info;
            Some(Common {
                groups: design.groups.iter().map(|g| (g.hypothesis, g.columns.clone())).collect(),
                prior: design.prior.clone(),
                h: info.h,
                g: info.g,
                yy: info.yy,
                scores,
            })
        })
    }
}
