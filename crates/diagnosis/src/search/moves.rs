use crate::regression::problem::HypothesisSet;
use crate::search::admit::Admitted;
use crate::search::change::Change;
use crate::search::model_state::ModelState;
use crate::search::select::Selection;
use crate::signals::response::Response;

/// The changes that are proposed.
impl<'a> Selection<'a> {
    /// The admissible entry of most evidence: of one hypothesis, else of two.
    pub fn best_entry(&self, state: &ModelState<'a>) -> Option<ModelState<'a>> {
        let ranked = self.rank(&state.model, &state.fit);
        let one = ranked.iter().find_map(|&g| self.admit(state, &Change::enter(&[g])).ok());
        let two = || ranked.iter().find_map(|&g| self.best_pair_with(state, g));
        one.or_else(two).map(|admitted| admitted.state)
    }

    /// The entry of `g` with a partner near it. `g` reduces a described parameter and does not predict better alone.
    /// Described damping that is too large and missing Coulomb friction cancel, for example, so neither enters alone.
    fn best_pair_with(&self, state: &ModelState<'a>, g: usize) -> Option<Admitted<'a>> {
        let one = ModelState::new(self.problem, self.with(&state.model, g))?;
        if !self.reduces_description(&one, g) {
            return None;
        }
        let groups = &self.problem.design.groups;
        let is_near = |h: &usize| groups[*h].joints.iter().any(|j| groups[g].joints.contains(j));
        let partners = self.rank(&one.model, &one.fit).into_iter().filter(is_near);
        let mut partners = partners.take(self.thresholds().partners);
        partners.find_map(|h| self.admit(state, &Change::enter(&[g, h])).ok())
    }

    /// Whether `g`, at a joint, reduces a parameter that is described there.
    fn reduces_description(&self, with: &ModelState, g: usize) -> bool {
        let design = self.problem.design;
        let group = &design.groups[g];
        let weights = with.fit.expand(design.width);
        let is_less = |&k: &usize| weights[k] < 0.0 && design.bounds[k].0.is_finite();
        group.hypothesis.joint().is_some() && group.columns.iter().any(is_less)
    }

    /// The admissible exchange of `g` for a neighbour of most evidence.
    pub fn best_exchange(&self, state: &ModelState<'a>, g: usize) -> Option<ModelState<'a>> {
        let rest = Change::leave(g).rest(&state.model);
        let is_outside = |h: &usize| !rest.contains(h) && !self.barred.contains(h);
        let outside = self.neighbours(g).into_iter().filter(is_outside);
        let exchanges = outside.filter_map(|h| self.admit(state, &Change::exchange(g, h)).ok());
        most_evident(exchanges).map(|admitted| admitted.state)
    }

    /// The admissible removal of most evidence: removals are asked in the order of the evidence that they cost, those
    /// of impossible sizes first.
    pub fn best_removal(&self, state: &ModelState<'a>) -> Option<ModelState<'a>> {
        let weights = state.fit.expand(self.problem.design.width);
        let gain = |g: usize| {
            let is_possible = self.is_admissible(&weights, g).is_ok();
            let rest = is_possible.then(|| Change::leave(g).rest(&state.model));
            let fit = rest.map(|rest| self.problem.fit(&rest));
            fit.map_or(f64::INFINITY, |fit| fit.map_or(f64::NEG_INFINITY, |fit| fit.evidence))
        };
        let mut removals: Vec<(usize, f64)> = state.model.iter().map(|&g| (g, gain(g))).collect();
        removals.sort_by(|a, b| b.1.total_cmp(&a.1));
        let mut admitted =
            removals.iter().filter_map(|&(g, _)| self.admit(state, &Change::leave(g)).ok());
        admitted.next().map(|admitted| admitted.state)
    }

    /// A state after all its admissible simplifications: the inertia of the link behind a joint becomes its rotor
    /// inertia, a gear ratio a torque constant, a torque offset and friction that grows with the load or differs with the
    /// direction Coulomb friction, friction of shared motors that of each joint.
    pub fn simplify(&self, mut state: ModelState<'a>) -> ModelState<'a> {
        for g in state.model.clone() {
            let change = self.simplification(g);
            let rest = change.rest(&state.model);
            if change.enter.iter().all(|plain| rest.contains(plain)) {
                continue;
            }
            state = self.admit(&state, &change).map_or(state, |admitted| admitted.state);
        }
        state
    }

    /// The change of `g` into its simpler rivals.
    pub fn simplification(&self, g: usize) -> Change {
        Change::simplify(&[g], &self.simpler_than(g))
    }

    /// The model without `g`, and with the first special case of `g` that is then admitted: `g` excluded it before.
    pub fn without(&self, model: &HypothesisSet, g: usize) -> HypothesisSet {
        let smaller = Change::leave(g).rest(model);
        let Some(state) = ModelState::new(self.problem, smaller.clone()) else { return smaller };
        let special_cases = self.special_cases_of(g);
        let ranked = self.rank(&state.model, &state.fit).into_iter();
        let mut entrants = ranked.filter(|h| special_cases.contains(h));
        let entry = entrants.find_map(|h| self.admit(&state, &Change::enter(&[h])).ok());
        entry.map_or(smaller, |admitted| admitted.state.model)
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
}

/// The change of most evidence; the first of several.
fn most_evident<'a>(changes: impl Iterator<Item = Admitted<'a>>) -> Option<Admitted<'a>> {
    changes.reduce(|best, next| if next.gain > best.gain { next } else { best })
}
