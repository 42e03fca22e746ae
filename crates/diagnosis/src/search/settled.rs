use std::collections::BTreeMap;

use logs::LogError;

use crate::error::DiagnosisError;
use crate::regression::problem::{Model, Problem};
use crate::regression::solved::{Solved, solved};
use crate::regression::uncertainty::untenable;
use crate::search::constancy::{Variation, variation};
use crate::search::contest::{Apart, Contest, Decided};
use crate::search::record::Record;
use crate::search::searched::Searched;
use crate::search::select::Selection;
use crate::search::study::Study;

/// Most contests in which a finding is exchanged for what does better in its place.
const EXCHANGES: usize = 4;

/// Effects without a name because their sizes would have to vary.
pub(crate) type Withheld = BTreeMap<usize, Variation>;

/// A model of sizes that are decided and constant, and the robot with it.
#[derive(Debug)]
pub(crate) struct Settled {
    pub model: Model,
    pub solution: Solved,
    pub withheld: Withheld,
}

impl Study<'_> {
    /// What a search came to once no twin of a finding does better in its place, and the twins that do
    /// worse.
    pub fn contested(
        &self,
        record: &Record,
        Searched { problem, model, solution }: &Searched,
    ) -> Result<(Settled, Apart), DiagnosisError> {
        let selection = record.selection(problem);
        let contest = Contest { study: self, selection: &selection };
        let (model, solution) = (model.clone(), solution.clone());
        let mut settled = self.settled(&selection, model, solution, Withheld::new())?;
        let mut left = EXCHANGES;
        loop {
            let Decided { apart, better } = contest.decide(&settled.model, &settled.solution)?;
            let has_name = |m: &Model| !m.iter().any(|g| settled.withheld.contains_key(g));
            match better.filter(|better| left > 0 && has_name(better)) {
                Some(better) => {
                    let solution = solved(self.robot, &self.log, problem, &better)?;
                    settled = self.settled(&selection, better, solution, settled.withheld)?;
                }
                None => return Ok((settled, apart)),
            }
            left -= 1;
        }
    }

    /// What is of a size that is decided and constant of a model, of which `solution` is the robot. What falls
    /// leaves its place to what says less.
    fn settled(
        &self,
        selection: &Selection,
        mut model: Model,
        mut solution: Solved,
        mut withheld: Withheld,
    ) -> Result<Settled, DiagnosisError> {
        let problem = selection.problem;
        let solve = |model: &Model| solved(self.robot, &self.log, problem, model);
        while let Some(plain) = selection.without_rare(&model) {
            model = plain;
            solution = solve(&model)?;
        }
        loop {
            let first = self.fitted(problem, &model, &solution);
            if let Some(g) = solution.tell(&first, |f| untenable(problem, &model, f)) {
                model = selection.without(&model, g);
                solution = solve(&model)?;
                continue;
            }
            let varying = self.varying(problem, &model, &withheld, &solution)?;
            if varying.is_empty() {
                return Ok(Settled { model, solution, withheld });
            }
            model.retain(|g| !varying.contains_key(g));
            withheld.extend(varying);
            solution = solve(&model)?;
        }
    }

    /// The effects of a model whose sizes would have to vary, where those that are `withheld` explain
    /// what they can.
    fn varying(
        &self,
        problem: &Problem,
        model: &Model,
        withheld: &Withheld,
        solution: &Solved,
    ) -> Result<Withheld, LogError> {
        let all: Model = model.iter().chain(withheld.keys()).copied().collect();
        let of = |solution: &Solved| {
            let first = self.fitted(problem, &all, solution);
            solution.tell(&first, |fitted| {
                let of = |&g: &usize| {
                    let group = &problem.design.groups[g];
                    let size: Vec<f64> =
                        group.columns.iter().map(|&k| solution.weights[k]).collect();
                    let last = fitted.problem.design.find(group.hypothesis)?;
                    Some((g, variation(fitted, last, &size)?))
                };
                model.iter().filter_map(of).collect()
            })
        };
        if withheld.is_empty() {
            return Ok(of(solution));
        }
        Ok(of(&solved(self.robot, &self.log, problem, &all)?))
    }
}
