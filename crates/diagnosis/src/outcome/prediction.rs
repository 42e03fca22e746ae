use logs::LogError;
use rayon::prelude::*;

use crate::error::DiagnosisError;
use crate::outcome::gain::HeldOutGain;
use crate::progress::Progress;
use crate::regression::blocks::Fold;
use crate::regression::problem::{Model, Problem};
use crate::regression::solved::{Solved, solved};
use crate::search::conclusion::Conclusion;
use crate::search::failed::Failed;
use crate::search::record::Record;
use crate::search::searched::Searched;
use crate::search::settled::Withheld;
use crate::search::study::Study;

impl Study<'_> {
    /// What predicts held-out efforts better than the description does of a conclusion, and by how
    /// much. A joint of which nothing does keeps its description.
    pub fn that_predicts<'b>(
        &self,
        record: &Record<'b>,
        by_run: &Problem<'b>,
        mut conclusion: Conclusion<'b>,
        progress: &dyn Progress,
    ) -> Result<(Conclusion<'b>, HeldOutGain), DiagnosisError> {
        progress.stage("testing on held-out data", by_run.folds.len());
        let search = |fold: &Fold| {
            let searched = self.searched(record, &fold.train);
            progress.step();
            searched
        };
        let searched: Vec<Searched> =
            by_run.folds.par_iter().map(search).collect::<Result<_, LogError>>()?;
        let withheld = &conclusion.withheld;
        let gain = |failed: &Failed| -> Result<HeldOutGain, LogError> {
            let named = |searched: &Searched| self.named(searched, withheld, failed);
            let folds = searched.par_iter().map(named).collect::<Result<_, LogError>>()?;
            Ok(HeldOutGain::new(record, by_run, folds))
        };
        let mut failed = Failed::default();
        let mut best = gain(&failed)?;
        while let Some(more) = failed.with_worse_joints(&best.inverse) {
            (best, failed) = (gain(&more)?, more);
        }
        let model = failed.kept(&conclusion.problem, &conclusion.model);
        failed.dropped = conclusion.model.difference(&model).copied().collect();
        if model != conclusion.model {
            let problem = &conclusion.problem;
            conclusion.solution = solved(self.robot, &self.log, problem, &model)?;
        }
        Ok((Conclusion { model, failed, ..conclusion }, best))
    }

    /// What a search came to, without what has no name over the whole record, what failed, and what is nothing
    /// about the robot that was fitted, such as bristles with a way that is not resolved.
    fn named(
        &self,
        searched: &Searched,
        withheld: &Withheld,
        failed: &Failed,
    ) -> Result<Solved, LogError> {
        let Searched { problem, model, solution } = searched;
        let mut named = failed.kept(problem, model);
        named.retain(|g| !withheld.contains_key(g));
        let mut solution = if named == *model {
            solution.clone()
        } else {
            solved(self.robot, &self.log, problem, &named)?
        };
        loop {
            let is_sound =
                |g: &usize| problem.design.groups[*g].hypothesis.is_sound(&solution.robot);
            let sound: Model = named.iter().copied().filter(is_sound).collect();
            if sound == named {
                return Ok(solution);
            }
            solution = solved(self.robot, &self.log, problem, &sound)?;
            named = sound;
        }
    }
}
