use std::cmp::Ordering;

use effects::{Hypothesis, Nature};
use robot::Robot;

use crate::regression::fit::Fit;
use crate::regression::problem::{HeldOut, Model, Problem};
use crate::regression::settle::settle;
use crate::signals::look::Look;
use crate::thresholds::{EVIDENCE, EVIDENCE_OF_DOUBTFUL, KEPT_BY_BODIES, MOST};

/// Rounds of entering, exchanging and leaving before the search is called settled.
const ROUNDS: usize = 4;

/// Partners that are tried, the most evident ones, with a hypothesis that predicts no better alone.
const PARTNERS: usize = 3;

/// Finds the hypotheses that earn their place.
///
/// Forward by evidence, each entrant gated by physics and by what it buys on held-out
/// blocks, alone or with another one; then exchange with hypotheses outside, then backward; until nothing
/// changes.
#[derive(Debug)]
pub(crate) struct Selection<'a> {
    pub problem: &'a Problem<'a>,
    pub robot: &'a Robot,
    /// Least fall of the held-out RMS error of each joint that counts (N·m or N).
    pub practical: Vec<f64>,
}

impl Selection<'_> {
    /// The model reached from `start`.
    pub fn run(&self, start: Model) -> Model {
        let mut model = start;
        for _ in 0..ROUNDS {
            let before = model.clone();
            self.forward(&mut model);
            self.exchange(&mut model);
            self.backward(&mut model);
            if model == before {
                break;
            }
        }
        self.plainer(&mut model);
        self.fewer(&mut model);
        model
    }

    /// Names one cause for two where it does the work of both: asymmetric friction for Coulomb
    /// friction with a torque offset of the same joint, at most half its level. The two are the
    /// same torque.
    fn fewer(&self, model: &mut Model) {
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

    /// Findings of a joint that `one` hypothesis may replace; not where another finding says how
    /// the level of the friction varies.
    fn two_for_one(&self, model: &Model, one: usize) -> Option<Vec<usize>> {
        let groups = &self.problem.design.groups;
        self.find(groups[one].hypothesis)?;
        let parts = groups[one].hypothesis.together();
        let varies = |g: &usize| groups[*g].hypothesis.varies().is_some_and(|h| parts.contains(&h));
        let two: Vec<usize> = parts.iter().map(|&part| self.find(part)).collect::<Option<_>>()?;
        let are_there = !two.is_empty() && two.iter().all(|g| model.contains(g));
        (are_there && !model.iter().any(varies)).then_some(two)
    }

    /// Names a disputed cause by its plainer rival, where that has as much evidence: rotor inertia
    /// for the inertia of the link behind the same joint, a torque constant for a gear ratio,
    /// Coulomb friction for one that grows with the load or differs with the direction, friction of each
    /// joint for that of motors they share.
    fn plainer(&self, model: &mut Model) {
        for g in model.clone() {
            let plain = self.plainer_than(g);
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
    fn is_as_evident(&self, other: &Model, model: &Model) -> bool {
        let evidence = |m: &Model| self.problem.fit(m).map(|f| f.evidence);
        evidence(other).zip(evidence(model)).is_some_and(|(o, m)| o > m - EVIDENCE)
    }

    /// The model without `g`, and with what says less of the same change at the same place, where
    /// that earns its place: `g` has kept it out.
    pub fn without(&self, model: &Model, g: usize) -> Model {
        let mut smaller = model.clone();
        smaller.remove(&g);
        let Some(fit) = self.problem.fit(&smaller) else { return smaller };
        let held_out = self.problem.held_out(&smaller);
        let less = self.says_less_than(g);
        let entrant = self.ranked(&smaller, &fit).into_iter().find(|h| {
            let larger = self.joined(&smaller, *h);
            less.contains(h) && self.is_possible(&larger, *h) && self.pays(&held_out, &larger, *h)
        });
        smaller.extend(entrant);
        smaller
    }

    /// Hypotheses of which `g` is the larger: its plainer rivals, the friction whose level it makes
    /// vary, and what it excludes with fewer weights.
    fn says_less_than(&self, g: usize) -> Vec<usize> {
        let groups = &self.problem.design.groups;
        let own = &groups[g];
        let part = |h: &usize| {
            own.hypothesis.varies() == Some(groups[*h].hypothesis)
                || own.hypothesis.excludes(groups[*h].hypothesis)
                    && groups[*h].columns.len() < own.columns.len()
        };
        let parts = (0..groups.len()).filter(part);
        self.plainer_than(g).into_iter().chain(parts).collect()
    }

    /// Hypotheses that have the name where they do the work of `g`, alone or together.
    fn plainer_than(&self, g: usize) -> Vec<usize> {
        let group = &self.problem.design.groups[g];
        let plain = group.hypothesis.plainer(&group.joints);
        plain.into_iter().filter_map(|h| self.find(h)).collect()
    }

    /// The group of a hypothesis that may be looked for.
    fn find(&self, hypothesis: Hypothesis) -> Option<usize> {
        self.problem.design.find(hypothesis)
    }

    fn forward(&self, model: &mut Model) {
        while let Some(fit) = self.problem.fit(model) {
            let held_out = self.problem.held_out(model);
            let entrant = self.ranked(model, &fit).into_iter().find(|&g| {
                let larger = self.joined(model, g);
                self.is_possible(&larger, g) && self.pays(&held_out, &larger, g)
            });
            let next = match entrant {
                Some(g) => Some(self.joined(model, g)),
                None => self.pair(model, &fit, &held_out),
            };
            let Some(next) = next else { break };
            *model = next;
        }
    }

    /// The model with two hypotheses of one joint that predict better together, though the first does not
    /// alone, where that takes back what is described: of damping that a description has too much of and
    /// friction that it lacks, which work against each other, a fit of one takes what the other
    /// leaves of it.
    fn pair(&self, model: &Model, fit: &Fit, before: &HeldOut) -> Option<Model> {
        let ranked = self.ranked(model, fit).into_iter();
        ranked.filter(|g| self.takes_back(model, *g)).find_map(|g| self.paired(model, g, before))
    }

    /// Whether `g`, at a joint, makes less of what is described there.
    fn takes_back(&self, model: &Model, g: usize) -> bool {
        let design = self.problem.design;
        let group = &design.groups[g];
        let Some(fit) = self.problem.fit(&self.joined(model, g)) else { return false };
        let weights = fit.expand(design.width);
        let is_less = |&k: &usize| weights[k] < 0.0 && design.bounds[k].0.is_finite();
        group.hypothesis.joint().is_some() && group.columns.iter().any(is_less)
    }

    /// See [`Selection::pair`]: with `g` as the first.
    fn paired(&self, model: &Model, g: usize, before: &HeldOut) -> Option<Model> {
        let groups = &self.problem.design.groups;
        let one = self.joined(model, g);
        let fit = self.problem.fit(&one)?;
        let is_near = |h: &usize| groups[*h].joints.iter().any(|j| groups[g].joints.contains(j));
        let earns = |two: &Model, h: usize| {
            let is_possible = |g| self.is_possible(two, g);
            let other = self.joined(model, h);
            two.contains(&g)
                && is_possible(g)
                && is_possible(h)
                && self.pays(before, two, g)
                && self.pays(&self.problem.held_out(&one), two, h)
                && self.pays(&self.problem.held_out(&other), two, g)
        };
        let partners = self.ranked(&one, &fit).into_iter().filter(is_near).take(PARTNERS);
        partners
            .map(|h| (self.joined(&one, h), h))
            .find(|(two, h)| earns(two, *h))
            .map(|(two, _)| two)
    }

    /// Hypotheses outside the model with enough evidence, the most evident first.
    fn ranked(&self, model: &Model, fit: &Fit) -> Vec<usize> {
        let all = 0..self.problem.design.groups.len();
        let mut ranked: Vec<(usize, f64)> = all
            .filter(|g| !model.contains(g))
            .map(|g| (g, self.evidence_gain(model, fit, g)))
            .collect();
        ranked.retain(|(g, gain)| *gain > self.least_evidence(*g));
        ranked.sort_by(|a, b| b.1.partial_cmp(&a.1).unwrap_or(Ordering::Equal));
        ranked.into_iter().map(|(g, _)| g).collect()
    }

    /// What `g` adds to the log evidence of a model, of which `fit` is the fit.
    pub fn evidence_gain(&self, model: &Model, fit: &Fit, g: usize) -> f64 {
        let columns = self.problem.new_columns(model, g);
        if columns.is_empty() || self.is_excluded(model, g) {
            f64::NEG_INFINITY
        } else if self.is_beside_the_plain(g) {
            self.beyond_the_plain(model, g)
        } else {
            fit.evidence_of(&self.problem.info, &columns, &self.problem.design.prior)
        }
    }

    /// What `g` adds to the log evidence of the model with all its plainer rivals: friction of
    /// shared motors is also that of each joint by itself.
    fn beyond_the_plain(&self, model: &Model, g: usize) -> f64 {
        let mut plain = model.clone();
        plain.extend(self.plainer_than(g));
        let Some(fit) = self.problem.fit(&plain) else { return f64::NEG_INFINITY };
        let columns = self.problem.new_columns(&plain, g);
        fit.evidence_of(&self.problem.info, &columns, &self.problem.design.prior)
    }

    /// Whether `h` has a name only beside its plainer rivals, and adds too little to a model with them.
    fn is_no_more(&self, model: &Model, h: usize) -> bool {
        self.is_beside_the_plain(h) && self.beyond_the_plain(model, h) <= self.least_evidence(h)
    }

    fn is_beside_the_plain(&self, g: usize) -> bool {
        let nature = self.problem.design.groups[g].hypothesis.nature();
        nature.is_some_and(Nature::adds_to_the_plain)
    }

    /// Least gain in log evidence for hypothesis `g`.
    pub fn least_evidence(&self, g: usize) -> f64 {
        let hypothesis = self.problem.design.groups[g].hypothesis;
        if hypothesis.is_doubtful() { EVIDENCE_OF_DOUBTFUL } else { EVIDENCE }
    }

    /// The model with the plainer rivals of a hypothesis in its place, where it adds less to them than what few
    /// arms have needs; none where no hypothesis does.
    pub fn without_rare(&self, model: &Model) -> Option<Model> {
        let is_rare = |g: &usize| {
            let rarity = self.problem.design.groups[*g]
                .hypothesis
                .rarity(self.robot, &effects::Priors::default());
            let least = self.least_evidence(*g) + rarity;
            rarity > 0.0 && self.beyond_the_plain(&removed(model, *g), *g) < least
        };
        let g = model.iter().copied().find(is_rare)?;
        let mut plain = removed(model, g);
        plain.extend(self.plainer_than(g));
        Some(plain)
    }

    /// Whether the model already holds another name for the same change, unless `g` says
    /// more than that other (asymmetric friction holds Coulomb friction).
    pub fn is_excluded(&self, model: &Model, g: usize) -> bool {
        let groups = &self.problem.design.groups;
        model.iter().any(|&m| {
            groups[m].hypothesis.excludes(groups[g].hypothesis)
                && groups[g].columns.len() <= groups[m].columns.len()
        })
    }

    /// The model with `g`, without what `g` says more than.
    pub fn joined(&self, model: &Model, g: usize) -> Model {
        let hypothesis = |g: usize| self.problem.design.groups[g].hypothesis;
        let mut larger = model.clone();
        larger.retain(|&m| !hypothesis(m).excludes(hypothesis(g)));
        larger.insert(g);
        larger
    }

    /// Whether the fitted weights of `g` are physically possible.
    pub fn is_possible(&self, model: &Model, g: usize) -> bool {
        let Some(fit) = self.problem.fit(model) else { return false };
        let all = fit.expand(self.problem.design.width);
        self.admits(&all, g) && self.is_body(model, g, &all)
    }

    /// Whether a change of a link's inertia keeps most of what it explains when every
    /// inertia is made physical; true for what is no link.
    fn is_body(&self, model: &Model, g: usize, weights: &[f64]) -> bool {
        let (problem, design) = (self.problem, self.problem.design);
        if design.groups[g].hypothesis.link().is_none() {
            return true;
        }
        let mut without = model.clone();
        without.remove(&g);
        let Some(fit) = problem.fit(&without) else { return false };
        let bare = problem.info.deviance(&fit.expand(design.width));
        let settled = settle(design, model, &problem.info, self.robot);
        let gain = bare - problem.info.deviance(weights);
        bare - problem.info.deviance(&settled) >= KEPT_BY_BODIES * gain
    }

    fn admits(&self, weights: &[f64], g: usize) -> bool {
        let group = &self.problem.design.groups[g];
        let own: Vec<f64> = group.columns.iter().map(|&k| weights[k]).collect();
        // A friction that wants to be negative is held at zero, and then is no change at all.
        let changes = own.iter().any(|w| w.abs() > 0.0);
        changes && group.hypothesis.admissible(self.robot, &own, &effects::Priors::default())
    }

    /// Whether `larger`, which has `g`, does enough better on held-out blocks than `before`: by
    /// what counts in practice, or by half of what was left (RMS).
    pub fn pays(&self, before: &HeldOut, larger: &Model, g: usize) -> bool {
        let after = self.problem.held_out(larger);
        let enough = |&j: &usize| {
            let fall = before.mean_square[j] - after.mean_square[j];
            fall > self.practical[j].powi(2).min(MOST.powi(2) * before.mean_square[j])
        };
        after.deviance < before.deviance && self.problem.design.groups[g].joints.iter().any(enough)
    }

    /// Replaces a hypothesis by one outside where that is more evident and no worse held out.
    fn exchange(&self, model: &mut Model) {
        for g in model.clone() {
            let Some(fit) = self.problem.fit(model) else { return };
            let held_out = self.problem.held_out(model).deviance;
            let mut best: Option<(f64, Model)> = None;
            for h in self.neighbours(g) {
                let mut other = model.clone();
                other.remove(&g);
                if other.contains(&h) || self.is_excluded(&other, h) || self.is_no_more(model, h) {
                    continue;
                }
                let other = self.joined(&other, h);
                let Some(evidence) = self.problem.fit(&other).map(|f| f.evidence) else { continue };
                let bar = best.as_ref().map_or(fit.evidence + 1.0, |(e, _)| *e);
                if evidence > bar
                    && self.is_possible(&other, h)
                    && self.problem.held_out(&other).deviance < held_out
                {
                    best = Some((evidence, other));
                }
            }
            if let Some((_, other)) = best {
                *model = other;
            }
        }
    }

    /// Hypotheses that the catalogue says are confused with `g`, where they share a joint; between
    /// two encoders, all of that joint.
    pub fn neighbours(&self, g: usize) -> Vec<usize> {
        let groups = &self.problem.design.groups;
        let confused = groups[g].hypothesis.kind.entry().confused_with;
        let all = self.problem.design.look == Look::Twist;
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

    /// Takes out, one at a time, what no longer earns its place.
    fn backward(&self, model: &mut Model) {
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
                    || !self.pays(&self.problem.held_out(&smaller), model, g);
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
fn removed(model: &Model, g: usize) -> Model {
    let mut smaller = model.clone();
    smaller.remove(&g);
    smaller
}
