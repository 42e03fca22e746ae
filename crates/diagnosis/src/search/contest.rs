use std::collections::BTreeSet;

use logs::LogError;

use crate::regression::problem::{Model, Problem};
use crate::regression::solved::{Solved, solved};
use crate::search::rivals::{contenders, replaced};
use crate::search::select::Selection;
use crate::search::study::Study;
use crate::search::worse::Worse;

/// Contests between a finding and its twin, decided about the robots that have one or the other: as
/// columns about the robot without, a delay and a lag are one.
#[derive(Debug)]
pub(crate) struct Contest<'a> {
    pub study: &'a Study<'a>,
    pub selection: &'a Selection<'a>,
}

/// Findings and those that do worse in their place once the robot has either.
pub(crate) type Apart = BTreeSet<(usize, usize)>;

/// What the contests of all findings came to.
#[derive(Debug, Default)]
pub(crate) struct Decided {
    pub apart: Apart,
    /// The model with what does better in the place of a finding, where anything does.
    pub better: Option<Model>,
}

impl Contest<'_> {
    /// Decides every finding of a solved model against its twin: the one that does better has the name.
    pub fn decide(&self, model: &Model, solution: &Solved) -> Result<Decided, LogError> {
        let problem = self.selection.problem;
        let here = self.deviance(model, solution);
        let mut decided = Decided::default();
        let mut best = 0.0;
        for (g, h) in self.pairs(model) {
            let mut without = model.clone();
            without.remove(&g);
            let other = replaced(problem, &without, g, h);
            let solution = solved(self.study.robot, &self.study.log, problem, &other)?;
            let there = self.deviance(&other, &solution);
            let worse = Worse::new(here.iter().copied().zip(there));
            if worse.is_told_apart() {
                decided.apart.insert((g, h));
            } else if worse.total < best {
                best = worse.total;
                decided.better = Some(other);
            }
        }
        Ok(decided)
    }

    /// Findings and their twins.
    fn pairs(&self, model: &Model) -> Vec<(usize, usize)> {
        let hypothesis = |g: usize| self.selection.problem.design.groups[g].hypothesis;
        let of = |&g: &usize| {
            let is_twin = |h: usize| hypothesis(h).is_twin(hypothesis(g));
            contenders(self.selection, model, g, is_twin).into_iter().map(move |(h, _)| (g, h))
        };
        model.iter().flat_map(of).collect()
    }

    /// Weighted sum of squares that a solved model leaves of every independent group of blocks.
    fn deviance(&self, model: &Model, solution: &Solved) -> Vec<f64> {
        let problem = self.selection.problem;
        let first = self.study.fitted(problem, model, solution);
        solution.tell(&first, |fitted| {
            let Problem { grams, weight, .. } = fitted.problem;
            let joint = |j: usize, b: usize| weight[j] * grams.remaining(j, &[b], fitted.weights).0;
            let block = |b: &usize| (0..weight.len()).map(|j| joint(j, *b)).sum::<f64>();
            let group = |blocks: Vec<usize>| blocks.iter().map(block).sum();
            fitted.problem.independent().into_iter().map(group).collect()
        })
    }
}
