use crate::outcome::findings::{Evidence, Found};
use crate::result::RuledOut;
use crate::search::conclusion::Conclusion;
use crate::search::record::Record;
use crate::search::study::Study;

/// What is told of a conclusion.
pub(crate) struct Told {
    pub found: Vec<Found>,
    pub ruled_out: Vec<RuledOut>,
    /// The smallest level of dry friction that would have been found at every joint (N·m or N).
    pub unseen_friction: Vec<f64>,
}

impl Study<'_> {
    /// The findings of a conclusion, and what they leave out.
    pub fn told(&self, record: &Record, conclusion: &Conclusion) -> Told {
        let Conclusion { problem, model, solution, apart, withheld, failed } = conclusion;
        let evidence =
            Evidence { selection: &record.selection(problem), model, apart, withheld, failed };
        let first = self.fitted(problem, model, solution);
        let found = solution.tell(&first, |fitted| evidence.findings(fitted));
        let unseen_friction = evidence.unseen_friction();
        Told { found, ruled_out: evidence.ruled_out(), unseen_friction }
    }
}
