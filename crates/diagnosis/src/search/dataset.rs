use robot::Robot;

use crate::columns::design::Design;
use crate::columns::stratum::Stratum;
use crate::regression::blocks::Block;
use crate::regression::gram::Grams;
use crate::regression::noise::Noise;
use crate::regression::problem::{HypothesisSet, Problem};
use crate::search::friction_error::FrictionError;
use crate::search::select::Selection;
use crate::thresholds::Thresholds;

/// The logs cut into blocks, shared by all searches on them.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Dataset<'a> {
    pub robot: &'a Robot,
    pub design: &'a Design,
    pub blocks: &'a [Block],
    pub grams: &'a Grams,
    /// Least fall of the held-out RMS error of each joint that counts (N·m or N).
    pub practical: &'a [f64],
    /// What the law of described dry friction may err by at each joint.
    pub friction: &'a [FrictionError],
    pub thresholds: &'a Thresholds,
}

impl<'a> Dataset<'a> {
    /// The problem on the blocks `of`, weighted by the residual noise of all hypotheses together on the blocks they
    /// are fitted to.
    ///
    /// This noise is too small. A search measures it again and corrects it, whereas noise that is too large would
    /// hide causes.
    pub fn problem(&self, of: &[usize]) -> Problem<'a> {
        let start = Noise::of_grams(&self.grams.sums(of), self.thresholds.signals.least_sliding);
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
        let moved = (0..self.design.joints()).filter(|j| self.design.moved[*j]);
        let mut times: Vec<f64> = moved.map(|j| noise.time[Stratum::sliding(j).index()]).collect();
        times.sort_by(f64::total_cmp);
        times.get(times.len() / 2).copied().unwrap_or(1.0)
    }

    /// A selection on `problem`.
    pub fn selection<'b>(&'b self, problem: &'b Problem<'b>) -> Selection<'b> {
        Selection {
            problem,
            robot: self.robot,
            practical: self.practical,
            friction: self.friction,
            barred: HypothesisSet::new(),
        }
    }
}
