use logs::LogError;
use robot::Robot;

use crate::error::DiagnosisError;
use crate::regression::problem::{Model, Problem};
use crate::regression::solved::{Solved, solved};
use crate::search::record::Record;
use crate::search::study::Study;

/// What a search came to, before any test of it.
pub(crate) struct Searched<'a> {
    pub problem: Problem<'a>,
    pub model: Model,
    pub solution: Solved,
}

impl Study<'_> {
    /// The robot with what a search over the whole record finds.
    pub fn extended(&self) -> Result<Robot, DiagnosisError> {
        self.with_record(|record| {
            let all: Vec<usize> = (0..record.blocks.len()).collect();
            Ok(self.searched(record, &all)?.solution.robot)
        })?
    }

    /// What a search on the blocks `of` comes to.
    pub fn searched<'b>(
        &self,
        record: &Record<'b>,
        of: &[usize],
    ) -> Result<Searched<'b>, LogError> {
        let (problem, model) = record.search(of);
        let solution = solved(self.robot, &self.log, &problem, &model)?;
        Ok(Searched { problem, model, solution })
    }
}
