use rayon::prelude::*;

use crate::regression::physical_inertias::physical_inertias;
use crate::regression::problem::{HypothesisSet, Problem};
use crate::search::dataset::Dataset;
use crate::search::select::Selection;
use crate::search::start::Start;

/// Most rounds of selecting a model and measuring its residual noise, and most sets that take the place of one cause.
const ROUNDS: usize = 4;

/// The model that a search selects.
#[derive(Debug)]
pub(crate) struct Selected<'a> {
    /// Weighted by the noise that the model leaves.
    pub problem: Problem<'a>,
    pub model: HypothesisSet,
}

impl<'a> Dataset<'a> {
    /// The model that the blocks `of` support.
    ///
    /// A search ends where no change is better, so the answer depends on where it begins: with the robot as described,
    /// with the everyday effects of every joint, or with what either of these finds. Another answer than the first is
    /// taken where it has more evidence by `rival_evidence` after every name has paid the evidence that it needs to
    /// enter, and physical bodies what they explain less than free ones: the mean of both weightings, by the noise of
    /// either answer.
    pub fn select_model(&self, of: &[usize]) -> Selected<'a> {
        let problem = self.problem(of);
        let select = |start: HypothesisSet| self.select_in(problem.clone(), start, None);
        let start = |start: Start| select(start.model(self.design));
        let (described, everyday) =
            rayon::join(|| start(Start::Described), || start(Start::Everyday));
        let mut others = Vec::new();
        if described.model != everyday.model {
            let union: HypothesisSet = described.model.union(&everyday.model).copied().collect();
            let is_new = union != described.model && union != everyday.model;
            others.push(everyday);
            others.extend(is_new.then(|| select(union)));
        }
        let least = self.thresholds.search.rival_evidence;
        let gains = others.into_iter().map(|other| (self.gain_over(&described, &other), other));
        let better = gains.filter(|(gain, _)| *gain > least);
        let best = better.reduce(|a, b| if b.0 > a.0 { b } else { a });
        self.with_sets_in_place_of_one(best.map_or(described, |(_, best)| best))
    }

    /// The answer after causes that are not everyday gave way to sets of others, one after the other, while that has
    /// more evidence by `rival_evidence`: first with the weights of the answer, then with those that the set measures.
    fn with_sets_in_place_of_one(&self, mut best: Selected<'a>) -> Selected<'a> {
        let is_odd = |g: &usize| !self.design.groups[*g].hypothesis.is_everyday();
        let least = self.thresholds.search.rival_evidence;
        for _ in 0..ROUNDS {
            let odd: Vec<usize> = best.model.iter().copied().filter(is_odd).collect();
            let now = self.evidence_after_names(&best.problem, &best.model);
            let others = odd.into_par_iter().map(|g| {
                let model = self.select_without(&best, g);
                (self.evidence_after_names(&best.problem, &model) - now, g, model)
            });
            let others: Vec<(f64, usize, HypothesisSet)> = others.collect();
            let most = others.into_iter().max_by(|a, b| a.0.total_cmp(&b.0));
            let Some((_, g, model)) = most.filter(|(gain, ..)| *gain > least) else { break };
            let weighted = self.weigh(&best.problem, &model);
            let other = self.select_in(weighted, model, Some(g));
            if self.gain_over(&best, &other) <= least {
                break;
            }
            best = other;
        }
        best
    }

    /// The model that a selection reaches which begins with the everyday effects of the joints of `g` in place of `g`,
    /// and in which `g` may not enter.
    fn select_without(&self, Selected { problem, model }: &Selected, g: usize) -> HypothesisSet {
        let groups = &self.design.groups;
        let shares = |h: &usize| groups[*h].joints.iter().any(|j| groups[g].joints.contains(j));
        let mut start = Start::Everyday.model(self.design);
        start.retain(shares);
        start.extend(model.iter().copied().filter(|&h| h != g));
        Selection { barred: HypothesisSet::from([g]), ..self.selection(problem) }.run(start)
    }

    /// What another answer has more of evidence after its names, in the mean of both weightings (nats).
    fn gain_over(&self, one: &Selected, other: &Selected) -> f64 {
        let over = |problem: &Problem| {
            self.evidence_after_names(problem, &other.model)
                - self.evidence_after_names(problem, &one.model)
        };
        0.5 * (over(&one.problem) + over(&other.problem))
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
        self.select_in(self.problem(of), start, None)
    }

    /// The same, where one hypothesis may not enter, with the weights of a problem to begin with.
    ///
    /// Every selection has the weights of the noise that the selection before it left. Where two answers lead to each
    /// other, the better one is taken, in the mean of the weightings by both.
    fn select_in(
        &self,
        problem: Problem<'a>,
        start: HypothesisSet,
        barred: Option<usize>,
    ) -> Selected<'a> {
        let barred: HypothesisSet = barred.into_iter().collect();
        let select = |problem: &Problem, model: HypothesisSet| {
            Selection { barred: barred.clone(), ..self.selection(problem) }.run(model)
        };
        let weighted = |problem: &Problem<'a>, model: HypothesisSet| Selected {
            problem: self.weigh(problem, &model),
            model,
        };
        let mut now = weighted(&problem, select(&problem, start));
        let mut before: Option<Selected> = None;
        for _ in 1..ROUNDS {
            let next = select(&now.problem, now.model.clone());
            if next == now.model {
                break;
            }
            if let Some(before) = before.filter(|before| before.model == next) {
                return if self.gain_over(&now, &before) > 0.0 { before } else { now };
            }
            let next = weighted(&now.problem, next);
            before = Some(std::mem::replace(&mut now, next));
        }
        now
    }

    /// A problem weighted by the noise that a model leaves.
    fn weigh(&self, problem: &Problem<'a>, model: &HypothesisSet) -> Problem<'a> {
        problem.with_weights(problem.noise(model).weights(&self.design.moved))
    }
}
