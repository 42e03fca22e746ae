use std::collections::BTreeSet;

use logs::LogError;
use rayon::prelude::*;
use robot::Robot;

use crate::error::DiagnosisError;
use crate::outcome::gain::HeldOutGain;
use crate::progress::Progress;
use crate::regression::blocks::Fold;
use crate::regression::problem::{Model, Problem};
use crate::regression::solved::{Solved, solved};
use crate::search::conclusion::Conclusion;
use crate::search::failed::{Failed, worse};
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
        let gain = |failed: &Failed, doubted: &BTreeSet<usize>| -> Result<HeldOutGain, LogError> {
            let left_out = LeftOut { withheld, failed, doubted };
            let named = |searched: &Searched| self.named(record, searched, left_out);
            let folds = searched.par_iter().map(named).collect::<Result<_, LogError>>()?;
            Ok(HeldOutGain::new(record, by_run, folds))
        };
        let mut failed = Failed::default();
        let mut best = gain(&failed, &BTreeSet::new())?;
        let doubted: BTreeSet<usize> = worse(&best.inverse).collect();
        if !doubted.is_empty() {
            best = gain(&failed, &doubted)?;
        }
        while let Some(more) = failed.with_worse_joints(&best.inverse) {
            (best, failed) = (gain(&more, &doubted)?, more);
        }
        let model = failed.kept(&conclusion.problem, &conclusion.model);
        failed.dropped = conclusion.model.difference(&model).copied().collect();
        if model != conclusion.model {
            let problem = &conclusion.problem;
            conclusion.solution = solved(self.robot, &self.log, problem, &model)?;
        }
        Ok((Conclusion { model, failed, ..conclusion }, best))
    }

    /// What a search came to, without what is left out; that leaves its place to what says less.
    fn named(
        &self,
        record: &Record,
        searched: &Searched,
        left_out: LeftOut,
    ) -> Result<Solved, LogError> {
        let Searched { problem, model, solution } = searched;
        let mut named = left_out.kept(problem, model);
        let mut solution = if named == *model {
            solution.clone()
        } else {
            solved(self.robot, &self.log, problem, &named)?
        };
        while let Some(g) = left_out.nothing(problem, &named, &solution.robot) {
            named = left_out.kept(problem, &record.selection(problem).without(&named, g));
            solution = solved(self.robot, &self.log, problem, &named)?;
        }
        Ok(solution)
    }
}

/// What a fold may have found and is not predicted with.
#[derive(Clone, Copy)]
struct LeftOut<'a> {
    /// What has no name over the whole record.
    withheld: &'a Withheld,
    failed: &'a Failed,
    /// Joints that are predicted worse than the description by all that their folds found.
    doubted: &'a BTreeSet<usize>,
}

impl LeftOut<'_> {
    fn kept(self, problem: &Problem, model: &Model) -> Model {
        let mut kept = self.failed.kept(problem, model);
        kept.retain(|g| !self.withheld.contains_key(g));
        kept
    }

    /// What is nothing about the robot that was fitted, at a joint that is doubted: bristles with a way that is not
    /// resolved have a damping of any size.
    fn nothing(self, problem: &Problem, model: &Model, robot: &Robot) -> Option<usize> {
        model.iter().copied().find(|&g| {
            let group = &problem.design.groups[g];
            group.joints.iter().any(|j| self.doubted.contains(j))
                && !group.hypothesis.is_sound(robot, &effects::Priors::default())
        })
    }
}
