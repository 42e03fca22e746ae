use std::cmp::Ordering;

use effects::{Hypothesis, Traits};
use robot::Robot;

use crate::regression::fit::Fit;
use crate::regression::problem::{HypothesisSet, Problem};
use crate::search::change::{Change, ChangeKind};
use crate::search::friction_error::FrictionError;
use crate::search::model_state::ModelState;
use crate::thresholds::search::SearchThresholds;

/// Most rounds of adding, exchanging and removing hypotheses.
const ROUNDS: usize = 4;

/// Selects the hypotheses that the blocks of a problem support.
///
/// `admit` asks the rules, the moves propose changes, and the loop takes them.
#[derive(Debug, Clone)]
pub(crate) struct Selection<'a> {
    pub problem: &'a Problem<'a>,
    pub robot: &'a Robot,
    /// Least fall of the held-out RMS error of each joint that counts (N·m or N).
    pub practical: &'a [f64],
    /// See [`Dataset::friction`](crate::search::dataset::Dataset::friction).
    pub friction: &'a [FrictionError],
    /// Hypotheses that may not enter.
    pub barred: HypothesisSet,
}

impl<'a> Selection<'a> {
    /// Takes admissible changes of the model `start`, those of most evidence first: hypotheses enter until none is
    /// admitted, then each is exchanged, then those that no longer hold leave. Simpler names come last.
    pub fn run(&self, start: HypothesisSet) -> HypothesisSet {
        let Some(mut state) = ModelState::new(self.problem, start.clone()) else { return start };
        for _ in 0..ROUNDS {
            let before = state.model.clone();
            while let Some(next) = self.best_entry(&state) {
                state = next;
            }
            for g in state.model.clone() {
                state = self.best_exchange(&state, g).unwrap_or(state);
            }
            while let Some(next) = self.best_removal(&state) {
                state = next;
            }
            if state.model == before {
                break;
            }
        }
        self.simplify(state).model
    }

    pub fn thresholds(&self) -> &SearchThresholds {
        &self.problem.thresholds.search
    }

    /// The group of a hypothesis, if the design includes it.
    pub fn find(&self, hypothesis: Hypothesis) -> Option<usize> {
        self.problem.design.find(hypothesis)
    }

    /// Hypotheses outside the model with enough evidence, the most evident first.
    pub fn rank(&self, model: &HypothesisSet, fit: &Fit) -> Vec<usize> {
        let all = 0..self.problem.design.groups.len();
        let mut ranked: Vec<(usize, f64)> = all
            .filter(|g| !model.contains(g))
            .map(|g| (g, self.evidence_gain(model, fit, g)))
            .collect();
        ranked.retain(|(g, gain)| *gain > self.least_evidence(*g));
        ranked.sort_by(|a, b| b.1.partial_cmp(&a.1).unwrap_or(Ordering::Equal));
        ranked.into_iter().map(|(g, _)| g).collect()
    }

    /// Gain in log evidence (nats) from adding `g` to a model, whose fit is `fit`.
    pub fn evidence_gain(&self, model: &HypothesisSet, fit: &Fit, g: usize) -> f64 {
        let columns = self.problem.new_columns(model, g);
        if columns.is_empty() || self.barred.contains(&g) || self.is_excluded(model, g) {
            f64::NEG_INFINITY
        } else if self.adds_to_simpler(g) {
            self.evidence_beyond_simpler(model, g)
        } else {
            fit.evidence_of(&self.problem.info, &columns, self.problem.design.weight_prior())
        }
    }

    /// Gain in log evidence (nats) from adding `g` to the model that also has all its simpler rivals. Friction of
    /// shared motors is thus compared with friction of each single joint.
    pub fn evidence_beyond_simpler(&self, model: &HypothesisSet, g: usize) -> f64 {
        let mut plain = model.clone();
        plain.extend(self.simpler_than(g));
        let Some(fit) = self.problem.fit(&plain) else { return f64::NEG_INFINITY };
        let columns = self.problem.new_columns(&plain, g);
        fit.evidence_of(&self.problem.info, &columns, self.problem.design.weight_prior())
    }

    /// Whether `g` needs evidence beyond its simpler rivals.
    pub fn adds_to_simpler(&self, g: usize) -> bool {
        let traits = self.problem.design.groups[g].hypothesis.traits();
        traits.is_some_and(Traits::adds_to_the_plain)
    }

    /// Least gain in log evidence for hypothesis `g`.
    pub fn least_evidence(&self, g: usize) -> f64 {
        let hypothesis = self.problem.design.groups[g].hypothesis;
        let t = self.thresholds();
        if hypothesis.is_imitable() { t.evidence_of_imitable } else { t.evidence }
    }

    /// Hypotheses that are preferred to `g` where they explain as much, alone or together.
    pub fn simpler_than(&self, g: usize) -> Vec<usize> {
        let group = &self.problem.design.groups[g];
        let plain = group.hypothesis.plainer(&group.joints);
        plain.into_iter().filter_map(|h| self.find(h)).collect()
    }

    /// Whether the model already has another name for the same change.
    pub fn is_excluded(&self, model: &HypothesisSet, g: usize) -> bool {
        self.other_name(model, g).is_some()
    }

    /// The hypothesis of a model that is another name for the same change. A more general `g` is allowed: asymmetric
    /// friction contains Coulomb friction.
    pub fn other_name(&self, model: &HypothesisSet, g: usize) -> Option<usize> {
        let groups = &self.problem.design.groups;
        model.iter().copied().find(|&m| {
            groups[m].hypothesis.excludes(groups[g].hypothesis)
                && groups[g].columns.len() <= groups[m].columns.len()
        })
    }

    /// The model with `g`, without the hypotheses that `g` excludes.
    pub fn with(&self, model: &HypothesisSet, g: usize) -> HypothesisSet {
        let hypothesis = |g: usize| self.problem.design.groups[g].hypothesis;
        let mut larger = model.clone();
        larger.retain(|&m| !hypothesis(m).excludes(hypothesis(g)));
        larger.insert(g);
        larger
    }

    /// The model after a change. Entrants put out what they exclude; simpler names do not.
    pub fn apply(&self, model: &HypothesisSet, change: &Change) -> HypothesisSet {
        let mut changed = change.rest(model);
        if change.kind == ChangeKind::Simplify {
            changed.extend(change.enter.iter().copied());
            return changed;
        }
        change.enter.iter().fold(changed, |model, &g| self.with(&model, g))
    }
}
