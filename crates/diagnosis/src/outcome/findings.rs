use logs::LogError;

use crate::outcome::finding_builder::{FindingBuilder, FindingWithFall};
use crate::result::RuledOut;
use crate::search::causes::Causes;
use crate::search::dataset::Dataset;
use crate::search::inputs::Inputs;

/// Causes as findings, and the hypotheses that are ruled out.
pub(crate) struct Findings {
    pub found: Vec<FindingWithFall>,
    pub ruled_out: Vec<RuledOut>,
    /// The smallest level of dry friction at every joint that the logs would have shown (N·m or N).
    pub unseen_friction: Vec<f64>,
}

impl Inputs<'_> {
    /// Builds the findings of `causes`, and the ledger of all other hypotheses.
    pub fn findings(&self, dataset: &Dataset, causes: &Causes) -> Result<Findings, LogError> {
        let Causes { problem, model, fitted, .. } = causes;
        let selection = &dataset.selection(problem);
        let ledger = &self.ledger_of(selection, causes)?;
        let builder = FindingBuilder { selection, model, ledger };
        let found = builder.findings(&fitted.last_fit(self.first_fit(problem, model, fitted)));
        let unseen_friction = builder.unseen_friction();
        Ok(Findings { found, ruled_out: builder.rule_out_others(), unseen_friction })
    }
}
