use robot::Robot;

use crate::columns::design::Design;
use crate::regression::blocks::Block;
use crate::regression::gram::Grams;
use crate::regression::noise::Noise;
use crate::regression::physical_inertias::physical_inertias;
use crate::regression::problem::{HypothesisSet, Problem};
use crate::search::select::Selection;
use crate::search::start::Start;
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

/// The model that a search selects.
#[derive(Debug)]
pub(crate) struct Selected<'a> {
    /// Weighted by the noise that the model leaves.
    pub problem: Problem<'a>,
    pub model: HypothesisSet,
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

    /// The model that the blocks `of` support.
    ///
    /// A search ends where no change is better, so the answer depends on where it begins: with the robot as described,
    /// with the everyday effects of every joint, or with what either of these finds. Another answer than the first is
    /// taken where it has more evidence by `rival_evidence` after every name has paid the evidence that it needs to
    /// enter, and physical bodies what they explain less than free ones: the mean of both weightings, by the noise of
    /// either answer.
    pub fn select_model(&self, of: &[usize]) -> Selected<'a> {
        let described = self.select_from(of, Start::Described.model(self.design));
        let everyday = self.select_from(of, Start::Everyday.model(self.design));
        if described.model == everyday.model {
            return described;
        }
        let united =
            self.select_from(of, described.model.union(&everyday.model).copied().collect());
        let gain = |other: &Selected| {
            let over = |problem: &Problem| {
                self.evidence_after_names(problem, &other.model)
                    - self.evidence_after_names(problem, &described.model)
            };
            0.5 * (over(&described.problem) + over(&other.problem))
        };
        let (of_everyday, of_united) = (gain(&everyday), gain(&united));
        let (most, other) =
            if of_united > of_everyday { (of_united, united) } else { (of_everyday, everyday) };
        if most > self.thresholds.search.rival_evidence { other } else { described }
    }

    /// The evidence of a model less what its names need to enter, and less what its bodies explain beyond physical ones.
    fn evidence_after_names(&self, problem: &Problem, model: &HypothesisSet) -> f64 {
        let selection = self.selection(problem);
        let names: f64 = model.iter().map(|&g| selection.least_evidence(g)).sum();
        let Some(fit) = problem.fit(model) else { return f64::NEG_INFINITY };
        let (info, sizes) = (&problem.info, &self.thresholds.sizes);
        let physical = physical_inertias(self.design, model, info, self.robot, sizes);
        let lost = info.deviance(&physical) - info.deviance(&fit.expand(self.design.width));
        fit.evidence - names - 0.5 * lost.max(0.0)
    }

    /// The model that a search reaches which begins with `start`.
    pub fn select_from(&self, of: &[usize], start: HypothesisSet) -> Selected<'a> {
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
        Selected { problem, model }
    }

    /// A selection on `problem`.
    pub fn selection<'b>(&'b self, problem: &'b Problem<'b>) -> Selection<'b> {
        Selection { problem, robot: self.robot, practical: self.practical.to_vec() }
    }
}
