use crate::regression::problem::{Model, Problem};
use crate::search::select::Selection;
use crate::search::worse::Worse;
use crate::thresholds::{EVIDENCE, MOST};

/// Least information on a weight, in those of its prior, that is more than rounding.
const SHOWN: f64 = 1e-9;

/// Hypotheses that explain the held-out data as well in place of `group`, block by block.
pub(crate) fn rivals(selection: &Selection, model: &Model, group: usize) -> Vec<usize> {
    let problem = selection.problem;
    let with = problem.held_out_by_block(model);
    let is_as_good = |rival: &Model| {
        let rival = problem.held_out_by_block(rival);
        !Worse::new(problem.of.iter().map(|&b| (with[b], rival[b]))).is_told_apart()
    };
    let contenders = contenders(selection, model, group, |_| true).into_iter();
    contenders.filter(|(_, rival)| is_as_good(rival)).map(|(h, _)| h).collect()
}

/// Those of the hypotheses asked for that explain much of the held-out data in place of `group`, be it
/// as well or not, and the model with them.
pub(crate) fn contenders(
    selection: &Selection,
    model: &Model,
    group: usize,
    is_asked_for: impl Fn(usize) -> bool,
) -> Vec<(usize, Model)> {
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
    let bare = problem.held_out(&without).deviance;
    let much = MOST * (bare - problem.held_out(model).deviance);
    let recovers = |h: usize| {
        let replaced = replaced(problem, &without, group, h);
        let left = selection.is_possible(&replaced, h).then(|| problem.held_out(&replaced))?;
        (bare - left.deviance > much).then_some((h, replaced))
    };
    candidates.into_iter().filter_map(recovers).collect()
}

/// Whether a hypothesis makes the logs nearly as likely as `group` does: about one posture a gap that
/// never opens is a turned encoder, though the catalogue does not say that the two are confused.
fn is_nearly_as_likely(problem: &Problem, without: &Model, group: usize) -> impl Fn(usize) -> bool {
    let fit = problem.fit(without);
    let evidence = move |g: usize| {
        let columns = problem.new_columns(without, g);
        fit.as_ref().map(|fit| fit.evidence_of(&problem.info, &columns, &problem.design.prior))
    };
    let least = evidence(group).map(|evidence| evidence - EVIDENCE);
    move |h| evidence(h) > least
}

/// The model with `rival` in the place of `group`. Asymmetric friction leaves its symmetric
/// part behind: only the asymmetry is disputed.
pub(crate) fn replaced(problem: &Problem, without: &Model, group: usize, rival: usize) -> Model {
    let mut model = without.clone();
    model.insert(rival);
    let hypothesis = problem.design.groups[group].hypothesis;
    let symmetric = hypothesis.together().first().and_then(|&level| problem.design.find(level));
    model.extend(symmetric);
    model
}

/// Whether `group` is `other` with some weights zero that the logs show, as Coulomb friction is
/// symmetric asymmetric friction: then `other` can only do as well, and is no rival. Of the inertia
/// of a link that turns about the vertical they show one number, which a rotor has as well.
fn is_special_case(problem: &Problem, group: usize, other: usize) -> bool {
    let columns = |g: usize| -> Vec<usize> {
        let all = problem.design.groups[g].columns.iter().copied();
        all.filter(|&k| is_shown(problem, k)).collect()
    };
    let (own, others) = (columns(group), columns(other));
    others.len() > own.len() && own.iter().all(|k| others.contains(k))
}

/// Whether the logs say anything of the weight of column `k` beside what is believed of it.
fn is_shown(problem: &Problem, k: usize) -> bool {
    problem.info.h[(k, k)] * problem.design.prior[k].powi(2) > SHOWN
}
