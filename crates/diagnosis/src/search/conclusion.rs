use logs::LogError;
use robot::Robot;

use crate::error::DiagnosisError;
use crate::progress::Progress;
use crate::regression::problem::{Model, Problem};
use crate::regression::solved::{Solved, solved};
use crate::search::contest::Apart;
use crate::search::failed::Failed;
use crate::search::idle::idle;
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

/// What a search came to whose effects all do what their columns say.
pub(crate) struct Searched<'a> {
    pub problem: Problem<'a>,
    pub model: Model,
    pub solution: Solved,
}

impl Study<'_> {
    /// The robot with what a search over the whole record finds, before any test of it.
    pub fn extended(&self) -> Result<Robot, DiagnosisError> {
        self.with_record(|record| {
            let all: Vec<usize> = (0..record.blocks.len()).collect();
            Ok(self.searched(record, &all)?.solution.robot)
        })?
    }

    /// What a search over the whole record comes to, of sizes that are decided and constant.
    pub fn conclusion<'b>(
        &self,
        record: &Record<'b>,
        progress: &dyn Progress,
    ) -> Result<Conclusion<'b>, DiagnosisError> {
        let all: Vec<usize> = (0..record.blocks.len()).collect();
        let Searched { problem, model, .. } = self.searched(record, &all)?;
        progress.step();
        let (Settled { model, solution, withheld }, apart) =
            self.contested(record, &problem, model)?;
        progress.step();
        let failed = Failed::default();
        Ok(Conclusion { problem, model, solution, apart, withheld, failed })
    }

    /// What a search on the blocks `of` comes to. It goes on without every effect that does less than
    /// its columns: these explain what the effect does not.
    pub fn searched<'b>(
        &self,
        record: &Record<'b>,
        of: &[usize],
    ) -> Result<Searched<'b>, LogError> {
        let (mut problem, mut model) = record.search(of);
        loop {
            let solution = solved(self.robot, &self.log, &problem, &model)?;
            let Some(g) = idle(self.robot, &self.log, (&problem, &model), &solution)? else {
                return Ok(Searched { problem, model, solution });
            };
            problem.idle.insert(g);
            model.remove(&g);
            (problem, model) = record.search_on(problem, model);
        }
    }
}
