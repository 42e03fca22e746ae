use crate::error::DiagnosisError;
use crate::progress::Progress;
use crate::regression::problem::{Model, Problem};
use crate::regression::solved::Solved;
use crate::search::contest::Apart;
use crate::search::failed::Failed;
use crate::search::record::Record;
use crate::search::settled::{Settled, Withheld};
use crate::search::study::Study;

/// What a search over the whole record came to.
pub(crate) struct Conclusion<'a> {
    pub problem: Problem<'a>,
    pub model: Model,
    pub solution: Solved,
    pub apart: Apart,
    pub withheld: Withheld,
    pub failed: Failed,
}

impl Study<'_> {
    /// What a search over the whole record comes to, of sizes that are decided and constant.
    pub fn conclusion<'b>(
        &self,
        record: &Record<'b>,
        progress: &dyn Progress,
    ) -> Result<Conclusion<'b>, DiagnosisError> {
        let all: Vec<usize> = (0..record.blocks.len()).collect();
        let searched = self.searched(record, &all)?;
        progress.step();
        let (Settled { model, solution, withheld }, apart) = self.contested(record, &searched)?;
        progress.step();
        let failed = Failed::default();
        Ok(Conclusion { problem: searched.problem, model, solution, apart, withheld, failed })
    }
}
