use catalogue::EffectKind;

use crate::problem::{HeldOut, Model, Problem};
use crate::select::Selection;

/// Least share of a finding's held-out gain that a rival must reach to be one.
const RECOVERS: f64 = 0.5;

/// Standard errors by which a rival must be worse to be told apart.
pub(crate) const TOLD_APART: f64 = 2.0;

/// Hypotheses that explain the held-out data as well in place of `group`.
///
/// With `d_b` the held-out deviance that block `b` gains when the rival takes the place of
/// the finding, the two are told apart if `mean(d) > 2 sd(d) / sqrt(blocks)`.
pub(crate) fn rivals(selection: &Selection, model: &Model, group: usize) -> Vec<usize> {
    let problem = selection.problem;
    let with = problem.held_out(model);
    let mut without = model.clone();
    without.remove(&group);
    let same = |h: &usize| {
        !is_worse(problem, &with, &problem.held_out(&replaced(problem, &without, group, *h)))
    };
    contenders(selection, model, group).into_iter().filter(same).collect()
}

/// Hypotheses that explain much of the held-out data in place of `group`, be it as well or not.
pub(crate) fn contenders(selection: &Selection, model: &Model, group: usize) -> Vec<usize> {
    let problem = selection.problem;
    let with = problem.held_out(model);
    let mut without = model.clone();
    without.remove(&group);
    let bare = problem.held_out(&without);
    selection
        .neighbours(group)
        .into_iter()
        .filter(|h| !model.contains(h) && !is_special_case(problem, group, *h))
        .filter(|&h| {
            let replaced = replaced(problem, &without, group, h);
            if !selection.is_possible(&replaced, h) {
                return false;
            }
            let recovered = bare.total() - problem.held_out(&replaced).total();
            recovered > RECOVERS * (bare.total() - with.total())
        })
        .collect()
}

/// The model with `rival` in the place of `group`. Asymmetric friction leaves its symmetric
/// part behind: only the asymmetry is disputed.
pub(crate) fn replaced(problem: &Problem, without: &Model, group: usize, rival: usize) -> Model {
    let mut model = without.clone();
    model.insert(rival);
    let hypothesis = problem.design.groups[group].hypothesis;
    if hypothesis.kind == EffectKind::AsymmetricFriction {
        let symmetric =
            effects::Hypothesis { kind: EffectKind::CoulombFriction, place: hypothesis.place };
        model.extend(problem.design.find(symmetric));
    }
    model
}

/// Whether `group` is `other` with some weights zero, as Coulomb friction is symmetric
/// asymmetric friction: then `other` can only do as well, and is no rival.
fn is_special_case(problem: &Problem, group: usize, other: usize) -> bool {
    let columns = |g: usize| &problem.design.groups[g].columns;
    columns(other).len() > columns(group).len()
        && columns(group).iter().all(|k| columns(other).contains(k))
}

fn is_worse(problem: &Problem, with: &HeldOut, rival: &HeldOut) -> bool {
    let n = problem.of.len() as f64;
    let change: Vec<f64> =
        problem.of.iter().map(|&b| rival.deviance[b] - with.deviance[b]).collect();
    let mean = change.iter().sum::<f64>() / n;
    let variance = change.iter().map(|d| (d - mean).powi(2)).sum::<f64>() / (n - 1.0).max(1.0);
    mean > TOLD_APART * (variance / n).sqrt()
}
