use std::cmp::Ordering;

use effects::{Hypothesis, Traits};
use robot::Robot;

use crate::regression::fit::Fit;
use crate::regression::physical_inertias::physical_inertias;
use crate::regression::problem::{HeldOutResiduals, HypothesisSet, Problem};
use crate::signals::response::Response;
use crate::thresholds::search::SearchThresholds;

/// Most rounds of adding, exchanging and removing hypotheses.
const ROUNDS: usize = 4;

/// Selects the hypotheses that the blocks of a problem support.
///
/// Hypotheses are added in the order of their evidence, alone or in pairs, where they are physically possible and
/// lower the error of held-out blocks. Then findings are exchanged for hypotheses outside the model, and the least
/// supported ones are removed. These steps repeat until nothing changes.
#[derive(Debug)]
pub(crate) struct Selection<'a> {
    pub problem: &'a Problem<'a>,
    pub robot: &'a Robot,
    /// Least fall of the held-out RMS error of each joint that counts (N·m or N).
    pub practical: Vec<f64>,
}

impl Selection<'_> {
    fn thresholds(&self) -> &SearchThresholds {
        &self.problem.thresholds.search
    }

    /// Searches from the model `start`.
    pub fn run(&self, start: HypothesisSet) -> HypothesisSet {
        let mut model = start;
        for _ in 0..ROUNDS {
            let before = model.clone();
            self.add(&mut model);
            self.exchange(&mut model);
            self.remove(&mut model);
            if model == before {
                break;
            }
        }
        self.prefer_simpler(&mut model);
        self.merge_pairs(&mut model);
        model
    }

    /// Replaces two findings by one with the same torque: Coulomb friction and a torque offset of the same joint, of
    /// at most half its level, by asymmetric friction.
    fn merge_pairs(&self, model: &mut HypothesisSet) {
        for one in 0..self.problem.design.groups.len() {
            let Some(two) = self.two_for_one(model, one) else { continue };
            let mut other = model.clone();
            other.retain(|g| !two.contains(g));
            other.insert(one);
            if self.is_possible(&other, one) && self.is_as_evident(&other, model) {
                *model = other;
            }
        }
    }

    /// Findings of a joint that the hypothesis `one` may replace. `None` where another finding makes the level of the
    /// friction vary.
    fn two_for_one(&self, model: &HypothesisSet, one: usize) -> Option<Vec<usize>> {
        let groups = &self.problem.design.groups;
        self.find(groups[one].hypothesis)?;
        let parts = groups[one].hypothesis.together();
        let varies = |g: &usize| groups[*g].hypothesis.varies().is_some_and(|h| parts.contains(&h));
        let two: Vec<usize> = parts.iter().map(|&part| self.find(part)).collect::<Option<_>>()?;
        let are_there = !two.is_empty() && two.iter().all(|g| model.contains(g));
        (are_there && !model.iter().any(varies)).then_some(two)
    }

    /// Replaces findings by simpler rivals with as much evidence: the inertia of the link behind a joint by its rotor
    /// inertia, a gear ratio by a torque constant, friction that grows with the load or differs with the direction by
    /// Coulomb friction, friction of shared motors by that of each joint.
    fn prefer_simpler(&self, model: &mut HypothesisSet) {
        for g in model.clone() {
            let plain = self.simpler_than(g);
            let mut other = model.clone();
            other.remove(&g);
            if plain.is_empty() || plain.iter().all(|p| other.contains(p)) {
                continue;
            }
            other.extend(plain.iter().copied());
            let possible = || plain.iter().all(|&p| self.is_possible(&other, p));
            if self.is_as_evident(&other, model) && possible() {
                *model = other;
            }
        }
    }

    /// Whether `other` has about as much evidence as `model`.
    fn is_as_evident(&self, other: &HypothesisSet, model: &HypothesisSet) -> bool {
        let evidence = |m: &HypothesisSet| self.problem.fit(m).map(|f| f.evidence);
        let least = self.thresholds().rival_evidence;
        evidence(other).zip(evidence(model)).is_some_and(|(o, m)| o > m - least)
    }

    /// The model without `g`, and with the first special case of `g` that then qualifies: `g` excluded it before.
    pub fn without(&self, model: &HypothesisSet, g: usize) -> HypothesisSet {
        let mut smaller = model_without(model, g);
        let Some(fit) = self.problem.fit(&smaller) else { return smaller };
        let held_out = self.problem.hold_out(&smaller);
        let special_cases = self.special_cases_of(g);
        let entrant = self.rank(&smaller, &fit).into_iter().find(|h| {
            let larger = self.with(&smaller, *h);
            special_cases.contains(h)
                && self.is_possible(&larger, *h)
                && self.pays(&held_out, &larger, *h)
        });
        smaller.extend(entrant);
        smaller
    }

    /// Special cases of `g`: its simpler rivals, the friction whose level it makes vary, and the hypotheses with
    /// fewer weights that it excludes.
    fn special_cases_of(&self, g: usize) -> Vec<usize> {
        let groups = &self.problem.design.groups;
        let own = &groups[g];
        let part = |h: &usize| {
            own.hypothesis.varies() == Some(groups[*h].hypothesis)
                || own.hypothesis.excludes(groups[*h].hypothesis)
                    && groups[*h].columns.len() < own.columns.len()
        };
        let parts = (0..groups.len()).filter(part);
        self.simpler_than(g).into_iter().chain(parts).collect()
    }

    /// Hypotheses that are preferred to `g` where they explain as much, alone or together.
    fn simpler_than(&self, g: usize) -> Vec<usize> {
        let group = &self.problem.design.groups[g];
        let plain = group.hypothesis.plainer(&group.joints);
        plain.into_iter().filter_map(|h| self.find(h)).collect()
    }

    /// The group of a hypothesis, if the design includes it.
    fn find(&self, hypothesis: Hypothesis) -> Option<usize> {
        self.problem.design.find(hypothesis)
    }

    /// Adds hypotheses, the most evident first, until none qualifies.
    fn add(&self, model: &mut HypothesisSet) {
        while let Some(fit) = self.problem.fit(model) {
            let held_out = self.problem.hold_out(model);
            let entrant = self.rank(model, &fit).into_iter().find(|&g| {
                let larger = self.with(model, g);
                self.is_possible(&larger, g) && self.pays(&held_out, &larger, g)
            });
            let next = match entrant {
                Some(g) => Some(self.with(model, g)),
                None => self.pair(model, &fit, &held_out),
            };
            let Some(next) = next else { break };
            *model = next;
        }
    }

    /// The model with two hypotheses of one joint that predict better together. The first reduces a described
    /// parameter and does not predict better alone. Described damping that is too large and missing Coulomb friction
    /// cancel, for example, so neither enters alone.
    fn pair(
        &self,
        model: &HypothesisSet,
        fit: &Fit,
        before: &HeldOutResiduals,
    ) -> Option<HypothesisSet> {
        let ranked = self.rank(model, fit).into_iter();
        ranked
            .filter(|g| self.reduces_description(model, *g))
            .find_map(|g| self.pair_with(model, g, before))
    }

    /// Whether `g`, at a joint, reduces a parameter that is described there.
    fn reduces_description(&self, model: &HypothesisSet, g: usize) -> bool {
        let design = self.problem.design;
        let group = &design.groups[g];
        let Some(fit) = self.problem.fit(&self.with(model, g)) else { return false };
        let weights = fit.expand(design.width);
        let is_less = |&k: &usize| weights[k] < 0.0 && design.bounds[k].0.is_finite();
        group.hypothesis.joint().is_some() && group.columns.iter().any(is_less)
    }

    /// See [`Selection::pair`]: with `g` as the first.
    fn pair_with(
        &self,
        model: &HypothesisSet,
        g: usize,
        before: &HeldOutResiduals,
    ) -> Option<HypothesisSet> {
        let groups = &self.problem.design.groups;
        let one = self.with(model, g);
        let fit = self.problem.fit(&one)?;
        let is_near = |h: &usize| groups[*h].joints.iter().any(|j| groups[g].joints.contains(j));
        let earns = |two: &HypothesisSet, h: usize| {
            let is_possible = |g| self.is_possible(two, g);
            let other = self.with(model, h);
            two.contains(&g)
                && is_possible(g)
                && is_possible(h)
                && self.pays(before, two, g)
                && self.pays(&self.problem.hold_out(&one), two, h)
                && self.pays(&self.problem.hold_out(&other), two, g)
        };
        let partners =
            self.rank(&one, &fit).into_iter().filter(is_near).take(self.thresholds().partners);
        partners
            .map(|h| (self.with(&one, h), h))
            .find(|(two, h)| earns(two, *h))
            .map(|(two, _)| two)
    }

    /// Hypotheses outside the model with enough evidence, the most evident first.
    fn rank(&self, model: &HypothesisSet, fit: &Fit) -> Vec<usize> {
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
        if columns.is_empty() || self.is_excluded(model, g) {
            f64::NEG_INFINITY
        } else if self.adds_to_simpler(g) {
            self.evidence_beyond_simpler(model, g)
        } else {
            fit.evidence_of(&self.problem.info, &columns, &self.problem.design.prior)
        }
    }

    /// Gain in log evidence (nats) from adding `g` to the model that also has all its simpler rivals. Friction of
    /// shared motors is thus compared with friction of each single joint.
    fn evidence_beyond_simpler(&self, model: &HypothesisSet, g: usize) -> f64 {
        let mut plain = model.clone();
        plain.extend(self.simpler_than(g));
        let Some(fit) = self.problem.fit(&plain) else { return f64::NEG_INFINITY };
        let columns = self.problem.new_columns(&plain, g);
        fit.evidence_of(&self.problem.info, &columns, &self.problem.design.prior)
    }

    /// Whether `h` must explain more than its simpler rivals, but adds too little to a model with them.
    fn adds_too_little(&self, model: &HypothesisSet, h: usize) -> bool {
        self.adds_to_simpler(h) && self.evidence_beyond_simpler(model, h) <= self.least_evidence(h)
    }

    /// Whether `g` needs evidence beyond its simpler rivals.
    fn adds_to_simpler(&self, g: usize) -> bool {
        let traits = self.problem.design.groups[g].hypothesis.traits();
        traits.is_some_and(Traits::adds_to_the_plain)
    }

    /// Least gain in log evidence for hypothesis `g`.
    pub fn least_evidence(&self, g: usize) -> f64 {
        let hypothesis = self.problem.design.groups[g].hypothesis;
        let t = self.thresholds();
        if hypothesis.is_imitable() { t.evidence_of_imitable } else { t.evidence }
    }

    /// The model with a rare effect replaced by its simpler rivals, where its evidence beyond them is less than an
    /// effect of few arms needs.
    pub fn without_rare(&self, model: &HypothesisSet) -> Option<HypothesisSet> {
        let is_rare = |g: &usize| {
            let prior_log_odds_against = self.problem.design.groups[*g]
                .hypothesis
                .prior_log_odds_against(self.robot, &self.problem.thresholds.priors);
            let least = self.least_evidence(*g) + prior_log_odds_against;
            prior_log_odds_against > 0.0
                && self.evidence_beyond_simpler(&model_without(model, *g), *g) < least
        };
        let g = model.iter().copied().find(is_rare)?;
        let mut plain = model_without(model, g);
        plain.extend(self.simpler_than(g));
        Some(plain)
    }

    /// Whether the model already has another name for the same change. A more general `g` is allowed: asymmetric
    /// friction contains Coulomb friction.
    pub fn is_excluded(&self, model: &HypothesisSet, g: usize) -> bool {
        let groups = &self.problem.design.groups;
        model.iter().any(|&m| {
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

    /// Whether the fitted weights of `g` are physically possible.
    pub fn is_possible(&self, model: &HypothesisSet, g: usize) -> bool {
        let Some(fit) = self.problem.fit(model) else { return false };
        let all = fit.expand(self.problem.design.width);
        self.admits(&all, g) && self.is_body(model, g, &all)
    }

    /// Whether a change of a link's inertia still explains most of the same when every inertia is made physical. True
    /// for other effects.
    fn is_body(&self, model: &HypothesisSet, g: usize, weights: &[f64]) -> bool {
        let (problem, design) = (self.problem, self.problem.design);
        if design.groups[g].hypothesis.link().is_none() {
            return true;
        }
        let mut without = model.clone();
        without.remove(&g);
        let Some(fit) = problem.fit(&without) else { return false };
        let bare = problem.info.deviance(&fit.expand(design.width));
        let sizes = &problem.thresholds.sizes;
        let physical = physical_inertias(design, model, &problem.info, self.robot, sizes);
        let gain = bare - problem.info.deviance(weights);
        bare - problem.info.deviance(&physical) >= self.thresholds().kept_by_bodies * gain
    }

    fn admits(&self, weights: &[f64], g: usize) -> bool {
        let group = &self.problem.design.groups[g];
        let own: Vec<f64> = group.columns.iter().map(|&k| weights[k]).collect();
        // Friction whose best level is negative is held at zero, which is no change.
        let changes = own.iter().any(|w| w.abs() > 0.0);
        changes && group.hypothesis.admissible(self.robot, &own, &self.problem.thresholds.priors)
    }

    /// Whether `larger`, which has `g`, lowers the error of held-out blocks by enough: by the practical share, or by
    /// half of the residual (RMS).
    pub fn pays(&self, before: &HeldOutResiduals, larger: &HypothesisSet, g: usize) -> bool {
        let after = self.problem.hold_out(larger);
        let share = self.thresholds().remaining_share;
        let enough = |&j: &usize| {
            let fall = before.mean_square[j] - after.mean_square[j];
            fall > self.practical[j].powi(2).min(share.powi(2) * before.mean_square[j])
        };
        after.deviance < before.deviance && self.problem.design.groups[g].joints.iter().any(enough)
    }

    /// Replaces a hypothesis by one outside the model that has more evidence and predicts held-out blocks no worse.
    fn exchange(&self, model: &mut HypothesisSet) {
        for g in model.clone() {
            let Some(fit) = self.problem.fit(model) else { return };
            let held_out = self.problem.hold_out(model).deviance;
            let mut best: Option<(f64, HypothesisSet)> = None;
            for h in self.neighbours(g) {
                let mut other = model.clone();
                other.remove(&g);
                if other.contains(&h)
                    || self.is_excluded(&other, h)
                    || self.adds_too_little(model, h)
                {
                    continue;
                }
                let other = self.with(&other, h);
                let Some(evidence) = self.problem.fit(&other).map(|f| f.evidence) else { continue };
                let bar = best
                    .as_ref()
                    .map_or(fit.evidence + self.thresholds().exchange_evidence, |(e, _)| *e);
                if evidence > bar
                    && self.is_possible(&other, h)
                    && self.problem.hold_out(&other).deviance < held_out
                {
                    best = Some((evidence, other));
                }
            }
            if let Some((_, other)) = best {
                *model = other;
            }
        }
    }

    /// Hypotheses that share a joint with `g` and that the catalogue lists as confused with it. Between two encoders,
    /// all hypotheses that share a joint.
    pub fn neighbours(&self, g: usize) -> Vec<usize> {
        let groups = &self.problem.design.groups;
        let confused = groups[g].hypothesis.kind.entry().confused_with;
        let all = self.problem.design.response == Response::Twist;
        let mut near = self.at_the_joints_of(g);
        near.retain(|&h| all || confused.contains(&groups[h].hypothesis.kind));
        near
    }

    /// Every other hypothesis that shares a joint with `g`.
    pub fn at_the_joints_of(&self, g: usize) -> Vec<usize> {
        let groups = &self.problem.design.groups;
        let shares = |h: &usize| groups[*h].joints.iter().any(|j| groups[g].joints.contains(j));
        (0..groups.len()).filter(|h| *h != g && shares(h)).collect()
    }

    /// Removes hypotheses that no longer qualify, the least evident first.
    fn remove(&self, model: &mut HypothesisSet) {
        loop {
            let Some(full) = self.problem.fit(model) else { return };
            let weights = full.expand(self.problem.design.width);
            let mut worst: Option<(f64, usize)> = None;
            for &g in model.iter() {
                let mut smaller = model.clone();
                smaller.remove(&g);
                let Some(fit) = self.problem.fit(&smaller) else { continue };
                let loss = if self.admits(&weights, g) {
                    full.evidence - fit.evidence
                } else {
                    f64::NEG_INFINITY
                };
                let is_spare = loss < self.least_evidence(g)
                    || !self.pays(&self.problem.hold_out(&smaller), model, g);
                if is_spare && worst.is_none_or(|(least, _)| loss < least) {
                    worst = Some((loss, g));
                }
            }
            let Some((_, g)) = worst else { return };
            model.remove(&g);
        }
    }
}

/// A model without one of its hypotheses.
fn model_without(model: &HypothesisSet, g: usize) -> HypothesisSet {
    let mut smaller = model.clone();
    smaller.remove(&g);
    smaller
}
