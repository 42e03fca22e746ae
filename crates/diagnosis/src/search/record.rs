use robot::Robot;

use crate::columns::design::Design;
use crate::regression::blocks::Block;
use crate::regression::gram::Grams;
use crate::regression::noise::Noise;
use crate::regression::problem::{Model, Problem};
use crate::search::select::Selection;

/// Rounds of selecting and measuring anew the noise that the selected model leaves.
const ROUNDS: usize = 4;

/// What every search on a record shares.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Record<'a> {
    pub robot: &'a Robot,
    pub design: &'a Design,
    pub blocks: &'a [Block],
    pub grams: &'a Grams,
    /// Least fall of the held-out RMS error of each joint that counts (N·m or N).
    pub practical: &'a [f64],
}

impl<'a> Record<'a> {
    /// The problem on the blocks `of`, weighted by the noise that all hypotheses together
    /// leave on the blocks they are fitted to: too little, which a search that measures it
    /// anew mends, while too much would hide the causes from it.
    pub fn problem(&self, of: &[usize]) -> Problem<'a> {
        let nothing = |j: usize| {
            let all = self.grams.joint(j, of);
            all.yy / all.count.max(1) as f64
        };
        let joints = self.design.joints();
        let start = Noise { variance: (0..joints).map(nothing).collect(), time: vec![1.0; joints] };
        let weight = start.weights(&self.design.moved);
        let rough = Problem::new(self.design, self.blocks, self.grams, of, weight);
        let noise = rough.fitted_noise(&rough.everything());
        rough.reweighted(noise.weights(&self.design.moved))
    }

    /// Median over joints of the autocorrelation time of what a model of everything leaves (samples).
    pub fn memory(&self) -> f64 {
        let all: Vec<usize> = (0..self.blocks.len()).collect();
        let problem = self.problem(&all);
        let noise = problem.noise(&problem.everything());
        let moved = noise.time.iter().zip(&self.design.moved).filter(|(_, m)| **m);
        let mut times: Vec<f64> = moved.map(|(t, _)| *t).collect();
        times.sort_by(f64::total_cmp);
        times.get(times.len() / 2).copied().unwrap_or(1.0)
    }

    /// The hypotheses that earn their place on the blocks `of`, and the problem weighted by the noise
    /// that they leave.
    pub fn search(&self, of: &[usize]) -> (Problem<'a>, Model) {
        let (mut problem, mut model) = (self.problem(of), Model::new());
        for _ in 0..ROUNDS {
            let next = self.selection(&problem).run(model.clone());
            let settled = next == model;
            model = next;
            problem = problem.reweighted(problem.noise(&model).weights(&self.design.moved));
            if settled {
                break;
            }
        }
        (problem, model)
    }

    /// A selection on `problem` with the record's gates.
    pub fn selection<'b>(&'b self, problem: &'b Problem<'b>) -> Selection<'b> {
        Selection { problem, robot: self.robot, practical: self.practical.to_vec() }
    }
}
