use catalogue::EffectKind;
use effects::{Hypothesis, Place};

use crate::regression::fit::Fit;
use crate::regression::physical_inertias::physical_inertias;
use crate::regression::problem::{HeldOutResiduals, HypothesisSet};
use crate::search::change::Change;
use crate::search::friction_error::{FrictionError, friction_level};
use crate::search::kept_nominal::KeptNominal;
use crate::search::model_state::ModelState;
use crate::search::paired_difference::PairedDifference;
use crate::search::refusal::Refusal;
use crate::search::select::Selection;

/// The rules about the first fit, and of pairs of models. Each returns what decided against a change.
impl Selection<'_> {
    /// No hypothesis of the model is another name for the same change.
    pub fn has_free_name(&self, model: &HypothesisSet, g: usize) -> Result<(), Refusal> {
        self.other_name(model, g).map_or(Ok(()), |of| Err(Refusal::OtherName { of }))
    }

    /// `g` has columns of its own, is no other name for a hypothesis of the model, and raises the log evidence by
    /// enough. Returns by how much (nats).
    pub fn adds_evidence(
        &self,
        (model, fit): (&HypothesisSet, &Fit),
        kept_nominal: Option<&KeptNominal>,
        g: usize,
    ) -> Result<f64, Refusal> {
        let groups = &self.problem.design.groups;
        self.has_free_name(model, g)?;
        if self.problem.new_columns(model, g).is_empty() {
            let shares =
                |m: &&usize| groups[**m].columns.iter().any(|k| groups[g].columns.contains(k));
            let of = model.iter().find(shares);
            return Err(of.map_or(Refusal::NotShown, |&of| Refusal::OtherName { of }));
        }
        let (gain, least) = (self.evidence_gain(model, fit, g), self.least_evidence(g));
        let kept = kept_nominal.and_then(|kept| kept.refusal(self.problem.design, g));
        match kept.filter(|_| gain > 0.0) {
            Some(refusal) => Err(refusal),
            None if gain > least => Ok(gain),
            None if self.adds_to_simpler(g) => Err(Refusal::AddsTooLittle { gain, least }),
            None if !gain.is_finite() => Err(Refusal::NotShown),
            None => {
                let taken_by = self.taken_by(model, g);
                Err(Refusal::TooLittleEvidence { gain, least, taken_by })
            }
        }
    }

    /// The hypothesis of a model without which `g` would raise the log evidence by enough; the one without which it
    /// would by most.
    fn taken_by(&self, model: &HypothesisSet, g: usize) -> Option<usize> {
        let groups = &self.problem.design.groups;
        let is_near = |m: &usize| groups[*m].joints.iter().any(|j| groups[g].joints.contains(j));
        let gain_without = |m: usize| {
            let smaller = Change::leave(m).rest(model);
            let fit = self.problem.fit(&smaller)?;
            let gain = self.evidence_gain(&smaller, &fit, g);
            (gain > self.least_evidence(g)).then_some((gain, m))
        };
        let near = model.iter().copied().filter(is_near);
        near.filter_map(gain_without).max_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, m)| m)
    }

    /// An effect that counts only for what it explains beyond its simpler rivals explains enough beyond them.
    pub fn adds_to_its_simpler(&self, model: &HypothesisSet, g: usize) -> Result<(), Refusal> {
        if !self.adds_to_simpler(g) {
            return Ok(());
        }
        let (gain, least) = (self.evidence_beyond_simpler(model, g), self.least_evidence(g));
        if gain <= least { Err(Refusal::AddsTooLittle { gain, least }) } else { Ok(()) }
    }

    /// A change is for simpler names where what leaves is an effect of few arms, whose log evidence beyond its simpler
    /// rivals is less than the prior odds demand. Returns the gain (nats) and why it leaves.
    pub fn is_rare(
        &self,
        change: &Change,
        model: &HypothesisSet,
    ) -> Result<(f64, Refusal), Refusal> {
        let rest = change.rest(model);
        let lacks = |&g: &usize| {
            let hypothesis = self.problem.design.groups[g].hypothesis;
            let priors = &self.problem.thresholds.priors;
            let odds_against = hypothesis.prior_log_odds_against(self.robot, priors);
            let least = self.least_evidence(g) + odds_against;
            let beyond = || self.evidence_beyond_simpler(&rest, g);
            (odds_against > 0.0).then(beyond).filter(|gain| *gain < least).map(|gain| (gain, least))
        };
        let lacking = change.leave.iter().find_map(lacks);
        let kept = Refusal::TooLittleEvidence { gain: 0.0, least: 0.0, taken_by: None };
        lacking.map(|(gain, least)| (-gain, Refusal::AddsTooLittle { gain, least })).ok_or(kept)
    }

    /// The fitted weights of everything that enters are physically possible.
    pub fn are_possible(&self, after: &ModelState, change: &Change) -> Result<(), Refusal> {
        change.enter.iter().try_for_each(|&g| self.is_possible(after, g))
    }

    /// The fitted weights of `g` are physically possible.
    pub fn is_possible(&self, state: &ModelState, g: usize) -> Result<(), Refusal> {
        let weights = state.fit.expand(self.problem.design.width);
        self.is_admissible(&weights, g)?;
        self.is_body(&state.model, g, &weights)
    }

    /// The fitted weights of `g` alone are a possible change.
    pub fn is_admissible(&self, weights: &[f64], g: usize) -> Result<(), Refusal> {
        let group = &self.problem.design.groups[g];
        let own: Vec<f64> = group.columns.iter().map(|&k| weights[k]).collect();
        // Friction whose best level is negative is held at zero, which is no change.
        let change = own.iter().copied().enumerate().find(|(_, w)| w.abs() > 0.0);
        let priors = &self.problem.thresholds.priors;
        if change.is_some() && group.hypothesis.admissible(self.robot, &own, priors) {
            return Ok(());
        }
        Err(Refusal::NotPhysical { weight: change })
    }

    /// A change of a link's inertia still explains most of the same when every inertia is made physical. Other effects
    /// are no bodies, and pass.
    fn is_body(&self, model: &HypothesisSet, g: usize, weights: &[f64]) -> Result<(), Refusal> {
        let (problem, design) = (self.problem, self.problem.design);
        if design.groups[g].hypothesis.link().is_none() {
            return Ok(());
        }
        let without = Change::leave(g).rest(model);
        let fit = problem.fit(&without).ok_or(Refusal::NotShown)?;
        let bare = problem.info.deviance(&fit.expand(design.width));
        let sizes = &problem.thresholds.sizes;
        let physical = physical_inertias(design, model, &problem.info, self.robot, sizes);
        let gain = bare - problem.info.deviance(weights);
        let explained = bare - problem.info.deviance(&physical);
        let least = self.thresholds().kept_by_bodies;
        if explained >= least * gain {
            return Ok(());
        }
        Err(Refusal::NoBody { kept: explained / gain, least })
    }

    /// What enters predicts held-out blocks better: as a whole at a joint of the first entrant, and each beside the
    /// others at a joint of its own.
    pub fn predict_better(
        &self,
        state: &ModelState,
        change: &Change,
        after: &ModelState,
    ) -> Result<(), Refusal> {
        if let Some(&first) = change.enter.first() {
            self.pays(state.held_out(), after, first)?;
        }
        if change.enter.len() < 2 {
            return Ok(());
        }
        change.enter.iter().try_for_each(|&g| {
            let others: Vec<usize> = change.enter.iter().copied().filter(|h| *h != g).collect();
            let beside = Change { enter: others, ..change.clone() };
            let before = self.problem.hold_out(&self.apply(&state.model, &beside));
            self.pays(&before, after, g)
        })
    }

    /// With `g` the error of held-out blocks falls by enough at one of its joints: by the practical share, or by half
    /// of the residual (RMS). What is like friction that turns must also explain more than described friction, of the level
    /// that the model leaves it, may have near rest, or more than its law may err by while the joint slides.
    pub fn pays(
        &self,
        before: &HeldOutResiduals,
        model: &ModelState,
        g: usize,
    ) -> Result<(), Refusal> {
        let after = model.held_out();
        let share = self.thresholds().remaining_share;
        let fall = |j: usize| before.mean_square[j] - after.mean_square[j];
        let group = &self.problem.design.groups[g];
        let is_like_it = group.hypothesis.is_like_turning_friction();
        let described = |j: usize| match is_like_it {
            true => self.friction_error(model, j),
            false => FrictionError::NONE,
        };
        let least = |j: usize| {
            let least = self.practical[j].powi(2).min(share.powi(2) * before.mean_square[j]);
            least.max(described(j).all.powi(2))
        };
        let pays_in_sliding = |j: usize| {
            let fall = before.mean_square_sliding[j] - after.mean_square_sliding[j];
            let error = described(j).sliding;
            error > 0.0 && fall > self.practical[j].max(error).powi(2)
        };
        let joints = &group.joints;
        if joints.iter().any(|&j| fall(j) > least(j) || pays_in_sliding(j)) {
            return lowers_deviance(before, after);
        }
        let lack = |j: usize| least(j) - fall(j);
        let at = joints.iter().copied().min_by(|&a, &b| lack(a).total_cmp(&lack(b)));
        let root = |square: f64| square.signum() * square.abs().sqrt();
        let [by, least] = at.map_or([0.0; 2], |j| [root(fall(j)), root(least(j))]);
        Err(Refusal::NoBetterPrediction { at, by, least })
    }

    /// What the law of described dry friction may err by at joint `j`, of the level that a model leaves of it.
    fn friction_error(&self, model: &ModelState, j: usize) -> FrictionError {
        let design = self.problem.design;
        let is_level = |g: &&usize| {
            let Hypothesis { kind, place } = design.groups[**g].hypothesis;
            let changes =
                matches!(kind, EffectKind::CoulombFriction | EffectKind::AsymmetricFriction);
            changes && place == Place::Joint(j)
        };
        let levels: Vec<usize> = model.model.iter().filter(is_level).copied().collect();
        if self.friction[j] == FrictionError::NONE || levels.is_empty() {
            return self.friction[j];
        }
        let (mut robot, weights) = (self.robot.clone(), model.fit.expand(design.width));
        for g in levels {
            let group = &design.groups[g];
            let own: Vec<f64> = group.columns.iter().map(|&c| weights[c]).collect();
            group.hypothesis.extend(&mut robot, &own, &design.frame, &design.priors);
        }
        self.friction[j].of_at_most(friction_level(&robot.links()[j].actuator))
    }

    /// A hypothesis of a model passes the rules for entering the model `without` it.
    pub fn still_qualifies(
        &self,
        state: &ModelState,
        without: &ModelState,
        g: usize,
    ) -> Result<(), Refusal> {
        self.is_admissible(&state.fit.expand(self.problem.design.width), g)?;
        let (gain, least) = (state.fit.evidence - without.fit.evidence, self.least_evidence(g));
        if gain < least {
            return Err(Refusal::TooLittleEvidence { gain, least, taken_by: None });
        }
        self.pays(without.held_out(), state, g)
    }
}

/// The log evidence of a changed model is larger by more than `least` (nats). Returns by how much.
pub(crate) fn is_more_evident(
    state: &ModelState,
    after: &ModelState,
    least: f64,
) -> Result<f64, Refusal> {
    let gain = after.fit.evidence - state.fit.evidence;
    if after.fit.evidence > state.fit.evidence + least {
        return Ok(gain);
    }
    Err(Refusal::TooLittleEvidence { gain, least, taken_by: None })
}

/// The weighted sum of squares of all joints on held-out blocks falls.
pub(crate) fn lowers_deviance(
    before: &HeldOutResiduals,
    after: &HeldOutResiduals,
) -> Result<(), Refusal> {
    if after.deviance < before.deviance {
        return Ok(());
    }
    let by = before.deviance - after.deviance;
    Err(Refusal::NoBetterPrediction { at: None, by, least: 0.0 })
}

/// Of two twins, each fitted about the robot that has it, the second has the smaller deviance. Returns half the
/// difference (nats).
pub(crate) fn does_better(
    change: &Change,
    [here, there]: &[Vec<f64>; 2],
    most: f64,
) -> Result<f64, Refusal> {
    let difference = PairedDifference::new(here.iter().copied().zip(there.iter().copied()));
    let gain = -0.5 * difference.total;
    if difference.exceeds(most) {
        let twin = change.leave.first().copied().unwrap_or_default();
        let errors = difference.total / difference.error;
        return Err(Refusal::WorseThanTwin { twin, errors, most });
    }
    if gain > 0.0 {
        return Ok(gain);
    }
    Err(Refusal::TooLittleEvidence { gain, least: 0.0, taken_by: None })
}
