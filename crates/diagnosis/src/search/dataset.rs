use robot::Robot;

use crate::columns::design::Design;
use crate::regression::blocks::Block;
use crate::regression::gram::Grams;
use crate::regression::noise::Noise;
use crate::regression::problem::{HypothesisSet, Problem};
use crate::search::everyday::everyday;
use crate::search::select::Selection;
use crate::thresholds::Thresholds;

/// Most rounds of selecting a model and measuring its residual noise.
const ROUNDS: usize = 4;

/// The logs cut into blocks, shared by all searches on them.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Dataset<'a> {
    pub robot: &'a Robot,
    pub design: &'a Design,
    pub blocks: &'a [Block],
    pub grams: &'a Grams,
    /// Least fall of the held-out RMS error of each joint that counts (N·m or N).
    pub practical: &'a [f64],
    pub thresholds: &'a Thresholds,
}

impl<'a> Dataset<'a> {
    /// The problem on the blocks `of`, weighted by the residual noise of all hypotheses together on the blocks they
    /// are fitted to.
    ///
    /// This noise is too small. A search measures it again and corrects it, whereas noise that is too large would
    /// hide causes.
    pub fn problem(&self, of: &[usize]) -> Problem<'a> {
        let power = |j: usize| {
            let all = self.grams.joint(j, of);
            all.yy / all.count.max(1) as f64
        };
        let joints = self.design.joints();
        let start = Noise { variance: (0..joints).map(power).collect(), time: vec![1.0; joints] };
        let weight = start.weights(&self.design.moved);
        let rough = Problem::new(self.design, self.blocks, self.grams, of, weight, self.thresholds);
        let noise = rough.training_noise(&rough.everything());
        rough.with_weights(noise.weights(&self.design.moved))
    }

    /// Median over joints of the autocorrelation time of the residual with all hypotheses in the model (samples).
    pub fn memory(&self) -> f64 {
        let all: Vec<usize> = (0..self.blocks.len()).collect();
        let problem = self.problem(&all);
        let noise = problem.noise(&problem.everything());
        let moved = noise.time.iter().zip(&self.design.moved).filter(|(_, m)| **m);
        let mut times: Vec<f64> = moved.map(|(t, _)| *t).collect();
        times.sort_by(f64::total_cmp);
        times.get(times.len() / 2).copied().unwrap_or(1.0)
    }

    /// The hypotheses that the blocks `of` support, and the problem weighted by their residual noise.
    ///
    /// A search ends where no single change is better, so the answer depends on where it begins. Of the one that begins
    /// with nothing and the one that begins with what every arm has, the answer with more evidence is taken, both
    /// weighted by the noise of either.
    pub fn select_model(&self, of: &[usize]) -> (Problem<'a>, HypothesisSet) {
        let (of_none, from_none) = self.select_from(of, HypothesisSet::new());
        let (of_all, from_everyday) = self.select_from(of, everyday(self.design));
        let evidence = |problem: &Problem, model: &HypothesisSet| {
            problem.fit(model).map_or(f64::NEG_INFINITY, |fit| fit.evidence)
        };
        let gain =
            |problem: &Problem| evidence(problem, &from_everyday) - evidence(problem, &from_none);
        if gain(&of_none) + gain(&of_all) > 0.0 {
            (of_all, from_everyday)
        } else {
            (of_none, from_none)
        }
    }

    /// The model that a search from the model `start` reaches.
    fn select_from(&self, of: &[usize], start: HypothesisSet) -> (Problem<'a>, HypothesisSet) {
        let (mut problem, mut model) = (self.problem(of), start);
        for _ in 0..ROUNDS {
            let next = self.selection(&problem).run(model.clone());
            let is_same = next == model;
            model = next;
            problem = problem.with_weights(problem.noise(&model).weights(&self.design.moved));
            if is_same {
                break;
            }
        }
        (problem, model)
    }

    /// A selection on `problem`.
    pub fn selection<'b>(&'b self, problem: &'b Problem<'b>) -> Selection<'b> {
        Selection { problem, robot: self.robot, practical: self.practical.to_vec() }
    }
}
