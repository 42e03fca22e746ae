use std::collections::BTreeSet;

use logs::LogError;

use crate::extend::{Solved, solved};
use crate::problem::{Model, Problem};
use crate::rivals::{TOLD_APART, contenders, replaced};
use crate::select::Selection;
use crate::study::Study;

/// Contests between a finding and its twin, decided about the robots that have one or the other: as
/// columns about the robot without, a delay and a lag are one.
#[derive(Debug)]
pub(crate) struct Contest<'a> {
    pub study: &'a Study<'a>,
    pub selection: &'a Selection<'a>,
}

/// What the contests of all findings came to.
#[derive(Debug, Default)]
pub(crate) struct Decided {
    /// Findings and those that do worse in their place.
    pub apart: BTreeSet<(usize, usize)>,
    /// The model with what does better in the place of a finding, where anything does.
    pub better: Option<Model>,
}

/// How much worse a model does than another, in weighted sum of squares.
struct Worse {
    total: f64,
    error: f64,
}

impl Contest<'_> {
    /// Decides every finding of a solved model against its twin: the one that does better has the name.
    ///
    /// With `d_b` what block `b` loses by the change, the two are told apart where
    /// `mean(d) > 2 sd(d) / sqrt(blocks)`.
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
            let worse = worse(&here, &self.deviance(&other, &solution));
            if worse.total > TOLD_APART * worse.error {
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
            let all = contenders(self.selection, model, g).into_iter();
            all.filter(move |&h| hypothesis(h).is_twin(hypothesis(g))).map(move |h| (g, h))
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

fn worse(own: &[f64], other: &[f64]) -> Worse {
    let n = own.len() as f64;
    let change: Vec<f64> = other.iter().zip(own).map(|(o, d)| o - d).collect();
    let mean = change.iter().sum::<f64>() / n;
    let variance = change.iter().map(|d| (d - mean).powi(2)).sum::<f64>() / (n - 1.0).max(1.0);
    Worse { total: n * mean, error: (n * variance).sqrt() }
}
