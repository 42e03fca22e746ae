use std::collections::BTreeSet;

use effects::Hypothesis;

use crate::outcome::effect_at::effect_at;
use crate::outcome::size::size;
use crate::outcome::unnamed::Unnamed;
use crate::regression::linear_fit::LinearFit;
use crate::regression::problem::{HeldOutResiduals, HypothesisSet};
use crate::regression::uncertainty::Uncertainty;
use crate::result::Finding;
use crate::search::ledger::Ledger;
use crate::search::rivals::rivals;
use crate::search::select::Selection;
use crate::signals::response::Response;

/// A finding, and the fall of the error at each joint that it causes.
#[derive(Debug, Clone)]
pub(crate) struct FindingWithFall {
    pub finding: Finding,
    /// Fall of the held-out mean square at every joint when the finding is added to the others.
    pub fall: Vec<f64>,
}

/// Held-out errors of the nominal model, of the model without a finding, and of the model with it.
#[derive(Clone, Copy)]
struct Errors<'a> {
    nominal: &'a HeldOutResiduals,
    without: &'a HeldOutResiduals,
    with: &'a HeldOutResiduals,
}

/// Builds findings from the accepted causes, and reasons against all other hypotheses.
#[derive(Debug)]
pub(crate) struct FindingBuilder<'a> {
    pub selection: &'a Selection<'a>,
    pub model: &'a HypothesisSet,
    /// What refuses every other hypothesis.
    pub ledger: &'a Ledger,
}

impl FindingBuilder<'_> {
    /// Every hypothesis of the model as a finding, with its size in the last fit; the largest share first.
    pub fn findings(&self, fitted: &LinearFit, unnamed: &Unnamed) -> Vec<FindingWithFall> {
        let problem = self.selection.problem;
        let Some(fit) = problem.fit(self.model) else { return Vec::new() };
        let Some(uncertainty) = Uncertainty::of(fitted) else { return Vec::new() };
        let uncertainty = uncertainty
            .with_unnamed_effects(|columns| unnamed.about(fitted.problem.design, columns));
        let with = problem.hold_out(self.model);
        let last = self.only_tangent().map(|g| (g, fitted.problem.hold_out(fitted.model)));
        let nominal = problem.hold_out(&HypothesisSet::new());
        let mut found: Vec<FindingWithFall> = self
            .model
            .iter()
            .copied()
            .filter(|g| self.modifier_of(*g).is_none())
            .map(|g| {
                let mut without = self.model.clone();
                without.remove(&g);
                without.retain(|&level| self.modifier_of(level) != Some(g));
                let bare = problem.hold_out(&without);
                let with = last.as_ref().filter(|(only, _)| *only == g).map_or(&with, |(_, l)| l);
                let fall: Vec<f64> =
                    bare.mean_square.iter().zip(&with.mean_square).map(|(b, w)| b - w).collect();
                let errors = Errors { nominal: &nominal, without: &bare, with };
                let mut finding = self.finding(g, &uncertainty, fitted, errors);
                finding.log_evidence =
                    problem.fit(&without).map_or(0.0, |f| fit.evidence - f.evidence);
                finding.evidence = self.words_for_evidence(g, finding.log_evidence, &bare, with);
                FindingWithFall { finding, fall }
            })
            .collect();
        found.sort_by(|a, b| b.finding.share_explained.total_cmp(&a.finding.share_explained));
        found
    }

    /// The finding whose columns are tangents, if there is exactly one. All that the last fit explains beyond the
    /// tangents is then due to it.
    fn only_tangent(&self) -> Option<usize> {
        let groups = &self.selection.problem.design.groups;
        let mut tangents =
            self.model.iter().copied().filter(|g| groups[*g].hypothesis.is_tangent());
        tangents.next().filter(|_| tangents.next().is_none())
    }

    /// The finding that replaces `g`, the Coulomb friction of a joint, in the report: the first in the model that
    /// makes its level vary.
    fn modifier_of(&self, g: usize) -> Option<usize> {
        let hypothesis = |g: usize| self.selection.problem.design.groups[g].hypothesis;
        let modifies = |m: &usize| hypothesis(*m).varies() == Some(hypothesis(g));
        self.model.iter().copied().find(modifies)
    }

    /// Forms of dry friction that these logs would not show beside Coulomb friction `g` even at half its level. They
    /// differ from it near rest, or at positions that the logs do not reach.
    fn hidden_beside(&self, g: usize, fitted: &LinearFit) -> Vec<usize> {
        let problem = self.selection.problem;
        let design = problem.design;
        let own = design.groups[g].hypothesis;
        let is_form = |h: &usize| design.groups[*h].hypothesis.varies() == Some(own);
        let forms: Vec<usize> = (0..design.groups.len()).filter(is_form).collect();
        let Some(j) = own.joint().filter(|_| !forms.is_empty()) else { return Vec::new() };
        let Some(fit) = problem.fit(self.model) else { return Vec::new() };
        let extended = fitted.robot();
        let drive = &extended.links()[j].actuator;
        let least = problem.thresholds.sizes.missed_form
            * drive.coulomb_forward.min(drive.coulomb_backward);
        let too_small = |h: &usize| self.smallest(*h, &fit).is_none_or(|smallest| smallest > least);
        forms.into_iter().filter(|h| !self.model.contains(h)).filter(too_small).collect()
    }

    /// Effects that explain as much as finding `g` together with other findings, such as asymmetric friction for
    /// Coulomb friction and an offset of the same joint.
    fn one_for_several(&self, g: usize) -> Vec<usize> {
        let design = self.selection.problem.design;
        let own = design.groups[g].hypothesis;
        let may_be = |one: &usize| {
            let parts = design.groups[*one].hypothesis.together();
            let others = || parts.iter().filter(|part| **part != own);
            let is_disputed = |part: &Hypothesis| {
                let part = design.find(*part).filter(|part| self.model.contains(part));
                part.is_some_and(|part| rivals(self.selection, self.model, part).contains(one))
            };
            parts.contains(&own) && others().count() > 0 && others().all(is_disputed)
        };
        (0..design.groups.len()).filter(may_be).collect()
    }

    /// Simpler effects that are equivalent to finding `g` when combined with one of its `rivals`, such as Coulomb
    /// friction with an offset for asymmetric friction.
    fn plain_parts(&self, g: usize, rivals: &[usize]) -> Vec<usize> {
        let design = self.selection.problem.design;
        let group = &design.groups[g];
        let plainer = group.hypothesis.plainer(&group.joints);
        let parts = group.hypothesis.together();
        let (plain, others): (Vec<_>, Vec<_>) =
            parts.into_iter().partition(|p| plainer.contains(p));
        let is_rival = |h: &Hypothesis| design.find(*h).is_some_and(|h| rivals.contains(&h));
        if !others.iter().any(is_rival) {
            return Vec::new();
        }
        plain.iter().filter_map(|h| design.find(*h)).collect()
    }

    /// All effects that explain as much as finding `g`, each once.
    fn not_separable_from(&self, g: usize, fitted: &LinearFit) -> Vec<usize> {
        let mut rivals = rivals(self.selection, self.model, g);
        rivals.retain(|&h| !self.ledger.is_worse_twin(g, h));
        rivals.extend(self.one_for_several(g));
        rivals.extend(self.plain_parts(g, &rivals));
        rivals.extend(self.hidden_beside(g, fitted));
        let mut seen = BTreeSet::new();
        rivals.retain(|&h| seen.insert(h));
        rivals
    }

    fn finding(
        &self,
        g: usize,
        uncertainty: &Uncertainty,
        fitted: &LinearFit,
        errors: Errors,
    ) -> Finding {
        let (problem, robot) = (self.selection.problem, self.selection.robot);
        let group = &problem.design.groups[g];
        let over =
            |of: &HeldOutResiduals| group.joints.iter().map(|&j| of.mean_square[j]).sum::<f64>();
        let Errors { nominal, without, with } = errors;
        let (before, without, after) = (over(nominal), over(without), over(with));
        let share = |whole: f64| {
            if whole > 0.0 { ((without - after) / whole).clamp(0.0, 1.0) } else { 0.0 }
        };
        let rivals = self.not_separable_from(g, fitted);
        let hypothesis = |m: &usize| problem.design.groups[*m].hypothesis;
        let level: Vec<Hypothesis> = self
            .model
            .iter()
            .filter(|m| self.modifier_of(**m) == Some(g))
            .map(hypothesis)
            .collect();
        let (wide, all) = uncertainty.undetermined_directions(&fitted.problem, group.hypothesis);
        let kind = |h: &usize| problem.design.groups[*h].hypothesis.kind;
        let open = match problem.design.response {
            Response::Effort => None,
            Response::Twist => kind(&g).left_open_by_two_encoders(),
        };
        Finding {
            at: effect_at(robot, group.hypothesis),
            parameters: uncertainty.estimates(fitted, group.hypothesis, &level),
            share_explained: share(before),
            held_out_gain: share(without),
            log_evidence: 0.0,
            told_apart_by: kind(&g).distinguishing_motion(rivals.iter().map(kind)),
            not_separable_from: rivals
                .iter()
                .map(|&h| effect_at(robot, problem.design.groups[h].hypothesis))
                .collect(),
            evidence: Vec::new(),
            undetermined: open.map_or_else(
                || words_for_directions(group.hypothesis, wide, all),
                |words| vec![words.to_owned()],
            ),
        }
    }

    fn words_for_evidence(
        &self,
        g: usize,
        loss: f64,
        bare: &HeldOutResiduals,
        with: &HeldOutResiduals,
    ) -> Vec<String> {
        let (problem, robot) = (self.selection.problem, self.selection.robot);
        let joints = &problem.design.groups[g].joints;
        let fall = |j: usize| bare.mean_square[j] - with.mean_square[j];
        let largest = joints.iter().copied().max_by(|&a, &b| {
            let relative = |j: usize| fall(j) / bare.mean_square[j].max(f64::MIN_POSITIVE);
            relative(a).total_cmp(&relative(b))
        });
        let mut evidence = Vec::new();
        if let Some(j) = largest {
            let [before, after] = [bare, with].map(|of| of.mean_square[j].sqrt());
            let link = &robot.links()[j];
            let (name, unit) =
                (&link.joint.name, if link.joint.kind.is_rotation() { "rad" } else { "m" });
            evidence.push(match problem.design.response {
                Response::Effort => format!(
                    "without it the held-out error at {name} is {} instead of {} N m RMS",
                    size(before), size(after)
                ),
                Response::Twist => format!(
                    "without it the held-out error between the two encoders of {name} is {before:.1e} instead of {after:.1e} {unit} RMS"
                ),
            });
        }
        evidence.push(format!("log evidence {loss:.0} higher with it than without"));
        evidence
    }
}

fn words_for_directions(hypothesis: Hypothesis, wide: usize, all: usize) -> Vec<String> {
    if wide == 0 || hypothesis.link().is_none() {
        return Vec::new();
    }
    vec![format!(
        "{wide} of {all} directions of its inertial parameters are not determined by these logs and stay at the nominal values"
    )]
}
