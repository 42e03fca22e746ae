use std::borrow::Cow;

use crate::search::change::{Change, ChangeKind};
use crate::search::model_state::ModelState;
use crate::search::refusal::Refusal;
use crate::search::rules::{does_better, is_more_evident, lowers_deviance};
use crate::search::select::Selection;

/// An admitted change.
#[derive(Debug)]
pub(crate) struct Admitted<'a> {
    /// The changed model.
    pub state: ModelState<'a>,
    /// Gain in log evidence (nats), by which admissible changes are ordered.
    pub gain: f64,
    /// Why the hypothesis that leaves no longer holds.
    pub because: Option<Refusal>,
}

impl<'a> Selection<'a> {
    /// Whether a change of a model is admitted: the only place where a rule is asked.
    ///
    /// | change | name | log evidence | physics | held-out blocks |
    /// |---|---|---|---|---|
    /// | enter | free | `evidence` or `evidence_of_imitable` more | possible | better by enough |
    /// | exchange | free | `exchange_evidence` more | possible | better |
    /// | simplify | | `rival_evidence` less at most | possible | |
    ///
    /// A hypothesis leaves where it no longer passes the rules for entering.
    ///
    /// Where the state has a last fit, the rules about it are asked: a hypothesis leaves where its size is not determined
    /// or not constant, one of few arms is simplified, and twins are compared by their deviances.
    pub fn admit(&self, state: &ModelState<'a>, change: &Change) -> Result<Admitted<'a>, Refusal> {
        match change.kind {
            ChangeKind::Enter => self.admit_entry(state, change),
            ChangeKind::Exchange => self.admit_exchange(state, change),
            ChangeKind::Simplify => self.admit_simpler(state, change),
            ChangeKind::Leave => self.admit_leaving(state, change),
        }
    }

    /// What enters is asked in order, each beside those before it.
    fn admit_entry(
        &self,
        state: &ModelState<'a>,
        change: &Change,
    ) -> Result<Admitted<'a>, Refusal> {
        let mut gain = 0.0;
        let (mut model, mut fit) = (state.model.clone(), Cow::Borrowed(&state.fit));
        for &g in &change.enter {
            gain += self.adds_evidence((&model, &fit), state.kept_nominal, g)?;
            model = self.with(&model, g);
            fit = Cow::Owned(self.problem.fit(&model).ok_or(Refusal::NotShown)?);
        }
        let after = self.after(state, change)?;
        self.are_possible(&after, change)?;
        self.predict_better(state, change, &after)?;
        Ok(Admitted { state: after, gain, because: None })
    }

    fn admit_exchange(
        &self,
        state: &ModelState<'a>,
        change: &Change,
    ) -> Result<Admitted<'a>, Refusal> {
        let after = self.after(state, change)?;
        if let Some(deviances) = &change.deviances {
            let gain = does_better(change, deviances, self.thresholds().rival_errors)?;
            return Ok(Admitted { state: after, gain, because: None });
        }
        let rest = change.rest(&state.model);
        for &h in &change.enter {
            self.has_free_name(&rest, h)?;
            self.adds_to_its_simpler(&state.model, h)?;
        }
        let gain = is_more_evident(state, &after, self.thresholds().exchange_evidence)?;
        self.are_possible(&after, change)?;
        lowers_deviance(state.held_out(), after.held_out())?;
        Ok(Admitted { state: after, gain, because: None })
    }

    fn admit_simpler(
        &self,
        state: &ModelState<'a>,
        change: &Change,
    ) -> Result<Admitted<'a>, Refusal> {
        let after = self.after(state, change)?;
        if state.last.is_some() {
            let (gain, because) = self.is_rare(change, &state.model)?;
            return Ok(Admitted { state: after, gain, because: Some(because) });
        }
        let gain = is_more_evident(state, &after, -self.thresholds().rival_evidence)?;
        self.are_possible(&after, change)?;
        Ok(Admitted { state: after, gain, because: None })
    }

    /// What leaves is admitted for the reason for which it would be refused.
    fn admit_leaving(
        &self,
        state: &ModelState<'a>,
        change: &Change,
    ) -> Result<Admitted<'a>, Refusal> {
        let after = self.after(state, change)?;
        let loss = state.fit.evidence - after.fit.evidence;
        let holds = |&g: &usize| match &state.last {
            Some(last) => self.has_a_size(last, g),
            None => self.still_qualifies(state, &after, g),
        };
        let Some(because) = change.leave.iter().find_map(|g| holds(g).err()) else {
            let least = change.leave.iter().map(|&g| self.least_evidence(g)).fold(0.0, f64::max);
            return Err(Refusal::TooLittleEvidence { gain: -loss, least: -least, taken_by: None });
        };
        let impossible = matches!(because, Refusal::NotPhysical { .. });
        let gain = if impossible { f64::INFINITY } else { -loss };
        Ok(Admitted { state: after, gain, because: Some(because) })
    }

    fn after(&self, state: &ModelState<'a>, change: &Change) -> Result<ModelState<'a>, Refusal> {
        let model = self.apply(&state.model, change);
        ModelState::new(self.problem, model).ok_or(Refusal::NotShown)
    }
}
