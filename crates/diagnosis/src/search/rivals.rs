use crate::regression::problem::{HypothesisSet, Problem};
use crate::search::model_state::ModelState;
use crate::search::paired_difference::PairedDifference;
use crate::search::select::Selection;

/// Hypotheses that explain the held-out data as well in place of `group`, block by block.
pub(crate) fn rivals(selection: &Selection, model: &HypothesisSet, group: usize) -> Vec<usize> {
    let problem = selection.problem;
    let errors = problem.thresholds.search.rival_errors;
    let with = problem.hold_out_by_block(model);
    let is_as_good = |rival: &HypothesisSet| {
        let rival = problem.hold_out_by_block(rival);
        !PairedDifference::new(problem.of.iter().map(|&b| (with[b], rival[b]))).exceeds(errors)
    };
    let contenders = contenders(selection, model, group, |_| true).into_iter();
    contenders.filter(|(_, rival)| is_as_good(rival)).map(|(h, _)| h).collect()
}

/// Hypotheses that explain at least half of the held-out gain of `group` in its place, better or worse, each with the
/// model that has it. Only hypotheses for which `is_asked_for` holds are tried.
pub(crate) fn contenders(
    selection: &Selection,
    model: &HypothesisSet,
    group: usize,
    is_asked_for: impl Fn(usize) -> bool,
) -> Vec<(usize, HypothesisSet)> {
    let problem = selection.problem;
    let asked_for =
        |h: &usize| is_asked_for(*h) && !model.contains(h) && !is_special_case(problem, group, *h);
    let mut without = model.clone();
    without.remove(&group);
    let mut candidates = selection.at_the_joints_of(group);
    candidates.retain(asked_for);
    let known = selection.neighbours(group);
    let is_likely = is_nearly_as_likely(problem, &without, group);
    candidates.retain(|&h| known.contains(&h) || is_likely(h));
    if candidates.is_empty() {
        return Vec::new();
    }
    let bare = problem.hold_out(&without).deviance;
    let much = problem.thresholds.search.rival_gain * (bare - problem.hold_out(model).deviance);
    let recovers = |h: usize| {
        let replaced = with_rival(problem, &without, group, h);
        let state = ModelState::new(problem, replaced)?;
        selection.is_possible(&state, h).ok()?;
        (bare - state.held_out().deviance > much).then_some((h, state.model))
    };
    candidates.into_iter().filter_map(recovers).collect()
}

/// Whether a hypothesis makes the logs nearly as likely as `group` does. This finds rivals beyond those of the
/// catalogue: about one posture, a gap that never opens is equivalent to an encoder offset.
fn is_nearly_as_likely(
    problem: &Problem,
    without: &HypothesisSet,
    group: usize,
) -> impl Fn(usize) -> bool {
    let fit = problem.fit(without);
    let evidence = move |g: usize| {
        let columns = problem.new_columns(without, g);
        fit.as_ref()
            .map(|fit| fit.evidence_of(&problem.info, &columns, problem.design.weight_prior()))
    };
    let least = evidence(group).map(|evidence| evidence - problem.thresholds.search.rival_evidence);
    move |h| evidence(h) > least
}

/// The model with `rival` in the place of `group`. For asymmetric friction only the asymmetry is replaced; its
/// symmetric part stays.
pub(crate) fn with_rival(
    problem: &Problem,
    without: &HypothesisSet,
    group: usize,
    rival: usize,
) -> HypothesisSet {
    let mut model = without.clone();
    model.insert(rival);
    let hypothesis = problem.design.groups[group].hypothesis;
    let symmetric = hypothesis.together().first().and_then(|&level| problem.design.find(level));
    model.extend(symmetric);
    model
}

/// Whether `group` is `other` with some of its weights zero, as Coulomb friction is asymmetric friction without
/// asymmetry. Then `other` explains as much without being a rival.
///
/// Only weights that the logs show count. The inertia of a link that turns about the vertical has one such weight,
/// and so has a rotor.
fn is_special_case(problem: &Problem, group: usize, other: usize) -> bool {
    let columns = |g: usize| -> Vec<usize> {
        let all = problem.design.groups[g].columns.iter().copied();
        all.filter(|&k| is_shown(problem, k)).collect()
    };
    let (own, others) = (columns(group), columns(other));
    others.len() > own.len() && own.iter().all(|k| others.contains(k))
}

/// Whether the logs say anything about the weight of column `k` beyond its prior.
fn is_shown(problem: &Problem, k: usize) -> bool {
    problem.info.h[(k, k)] * problem.design.prior[k].powi(2) > problem.thresholds.search.informed
}
