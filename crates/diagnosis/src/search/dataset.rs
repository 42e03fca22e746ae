use robot::Robot;

use crate::columns::design::Design;
use crate::regression::blocks::Block;
use crate::regression::gram::Grams;
use crate::regression::noise::Noise;
use crate::regression::problem::Problem;
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
    /// RMS of the described dry friction of each joint near changes of direction (N·m or N).
    pub near_rest: &'a [f64],
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

    /// A selection on `problem`.
    pub fn selection<'b>(&'b self, problem: &'b Problem<'b>) -> Selection<'b> {
        Selection {
            problem,
            robot: self.robot,
            practical: self.practical,
            near_rest: self.near_rest,
            barred: None,
        }
    }
}
