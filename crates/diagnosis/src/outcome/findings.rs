use effects::Hypothesis;
use logs::LogError;

use crate::columns::design::Design;
use crate::outcome::finding_builder::{FindingBuilder, FindingWithFall};
use crate::outcome::unnamed::Unnamed;
use crate::regression::fitted_model::FittedModel;
use crate::regression::gram::Grams;
use crate::regression::problem::Problem;
use crate::result::RuledOut;
use crate::search::causes::Causes;
use crate::search::dataset::Dataset;
use crate::search::inputs::Inputs;
use crate::search::select::Selection;

/// Causes as findings, and the hypotheses that are ruled out.
pub(crate) struct Findings {
    pub found: Vec<FindingWithFall>,
    pub ruled_out: Vec<RuledOut>,
    /// The smallest level of dry friction at every joint that the logs would have shown (N·m or N).
    pub unseen_friction: Vec<f64>,
}

impl Inputs<'_> {
    /// All hypotheses about the robot with its findings.
    fn design_about(&self, problem: &Problem, fitted: &FittedModel) -> Result<Design, LogError> {
        let all: Vec<Hypothesis> = problem.design.groups.iter().map(|g| g.hypothesis).collect();
        problem.design.about(&fitted.robot, &self.log, &all)
    }

    /// Builds the findings of `causes`, and the ledger of all other hypotheses.
    pub fn findings(&self, dataset: &Dataset, causes: &Causes) -> Result<Findings, LogError> {
        let Causes { problem, model, fitted, .. } = causes;
        let selection = &dataset.selection(problem);
        let ledger = &self.ledger_of(selection, causes)?;
        let builder = FindingBuilder { selection, model, ledger };
        let last = fitted.last_fit(self.first_fit(problem, model, fitted));
        let design = self.design_about(problem, fitted)?;
        let grams = Grams::new(&design, problem.blocks);
        let repaired = &problem.about(&design, &grams);
        let same = |g: &usize| design.find(problem.design.groups[*g].hypothesis);
        let about = Selection { problem: repaired, robot: &fitted.robot, ..selection.clone() };
        let unnamed = Unnamed::new(&about, &model.iter().filter_map(same).collect());
        let found = unnamed.map_or_else(Vec::new, |unnamed| builder.findings(&last, &unnamed));
        let unseen_friction = builder.unseen_friction();
        Ok(Findings { found, ruled_out: builder.rule_out_others(), unseen_friction })
    }
}
