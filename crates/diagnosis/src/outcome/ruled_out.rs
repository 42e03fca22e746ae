use catalogue::EffectKind;
use effects::{Hypothesis, Place, Weights};
use nalgebra::DMatrix;

use crate::outcome::effect_at::effect_at;
use crate::outcome::finding_builder::FindingBuilder;
use crate::regression::fit::{Complement, Fit};
use crate::regression::problem::Problem;
use crate::result::RuledOut;

impl FindingBuilder<'_> {
    /// Every hypothesis that is not a finding, with the smallest size that the logs would have shown.
    pub fn rule_out_others(&self) -> Vec<RuledOut> {
        let problem = self.selection.problem;
        let Some(fit) = problem.fit(self.model) else { return Vec::new() };
        let outside = (0..problem.design.groups.len()).filter(|g| !self.model.contains(g));
        outside.map(|g| self.rule_out(g, &fit)).collect()
    }

    fn rule_out(&self, g: usize, fit: &Fit) -> RuledOut {
        let (problem, robot) = (self.selection.problem, self.selection.robot);
        let group = &problem.design.groups[g];
        let rotation =
            group.hypothesis.joint().is_none_or(|j| robot.links()[j].joint.kind.is_rotation());
        let sharpest = self.sharpest_of(g, fit);
        let (weight, size) = sharpest.map_or((0, None), |(weight, size)| (weight, Some(size)));
        let (index, smallest_detectable) = parameter_of(group.hypothesis.kind, weight, size);
        let parameter = &group.hypothesis.kind.entry().parameters[index];
        RuledOut {
            at: effect_at(robot, group.hypothesis),
            parameter: parameter.name,
            smallest_detectable,
            unit: if rotation { parameter.unit } else { parameter.unit_prismatic },
            because: self.words_for_refusal(g, sharpest),
        }
    }

    /// The smallest level of dry friction that the logs would have shown at every joint without a finding of it (N·m
    /// or N). Zero where a form of it is a finding or none is looked for.
    pub fn unseen_friction(&self) -> Vec<f64> {
        let problem = self.selection.problem;
        let fit = problem.fit(self.model);
        let unseen = |j: usize| {
            let (kind, place) = (EffectKind::CoulombFriction, Place::Joint(j));
            let g = problem.design.find(Hypothesis { kind, place })?;
            let is_new = !problem.new_columns(self.model, g).is_empty();
            fit.as_ref().filter(|_| is_new).and_then(|fit| self.smallest(g, fit))
        };
        (0..problem.design.joints()).map(|j| unseen(j).unwrap_or(0.0)).collect()
    }

    /// The smallest weight of the first column of `g` that the logs would have shown for any shape, and for any phase
    /// of a wave. `None` where the logs do not show the column.
    pub fn smallest(&self, g: usize, fit: &Fit) -> Option<f64> {
        let problem = self.selection.problem;
        let columns = problem.new_columns(self.model, g);
        let complement = fit.complement(&problem.info, &columns, &problem.design.prior);
        let errors = standard_errors(problem, fit, &complement);
        let traits = problem.design.groups[g].hypothesis.traits();
        let has_phases = traits.is_some_and(|n| n.weights == Weights::Phases);
        let errors = errors.get(..if has_phases { 2 } else { 1 })?;
        let error = errors.iter().copied().fold(0.0, f64::max);
        Some(problem.thresholds.sizes.detected * error * self.largest_unseen(g))
    }

    fn largest_unseen(&self, g: usize) -> f64 {
        let design = self.selection.problem.design;
        design.groups[g].hypothesis.largest_unseen(
            self.selection.robot,
            &design.frame,
            &design.priors,
        )
    }

    /// The parameter that the logs show best, with its smallest detectable size.
    fn sharpest_of(&self, g: usize, fit: &Fit) -> Option<(usize, f64)> {
        let problem = self.selection.problem;
        let columns = problem.new_columns(self.model, g);
        if columns.is_empty() {
            return None;
        }
        let complement = fit.complement(&problem.info, &columns, &problem.design.prior);
        self.sharpest(g, &columns, &standard_errors(problem, fit, &complement))
    }

    /// Index and smallest detectable size of the parameter whose standard error is the smallest share of its prior;
    /// `None` if all standard errors are near the prior.
    fn sharpest(&self, g: usize, columns: &[usize], errors: &[f64]) -> Option<(usize, f64)> {
        let design = self.selection.problem.design;
        let hypothesis = design.groups[g].hypothesis;
        let parameters = hypothesis.kind.entry().parameters.len();
        let share = |k: usize| errors[k] / design.prior[columns[k]];
        let best =
            (0..errors.len().min(parameters)).min_by(|&a, &b| share(a).total_cmp(&share(b)))?;
        let t = &self.selection.problem.thresholds.sizes;
        let size = t.detected * errors[best] * self.largest_unseen(g);
        // The weights behind a centre of mass are first moments: m c.
        let mass = hypothesis.link().map(|l| self.selection.robot.links()[l].inertia.mass);
        let unit = if best > 0 { mass.filter(|m| *m > 0.0).unwrap_or(1.0) } else { 1.0 };
        (share(best) <= t.determined).then_some((best, size / unit))
    }
}

/// The parameter that the weight with index `weight` stands for, and its value for a size of the weight. The weight of a
/// spring is its compliance. The weight of Stribeck or presliding friction is reported as the parameter that the logs
/// would show ([`Weights::SeenBy`]).
fn parameter_of(kind: EffectKind, weight: usize, size: Option<f64>) -> (usize, Option<f64>) {
    match effects::model(kind).map(|model| model.traits().weights) {
        Ok(Weights::Reciprocal) => (weight, size.map(f64::recip)),
        Ok(Weights::SeenBy(parameter)) => (parameter, size),
        _ => (weight, size),
    }
}

/// Standard errors of the weights of a group outside the model: the larger of those by the likelihood and those by
/// the scatter of the blocks' scores.
fn standard_errors(problem: &Problem, fit: &Fit, complement: &Complement) -> Vec<f64> {
    let count = complement.b.nrows();
    let Some(inverse) = complement.b.clone().try_inverse() else {
        return vec![f64::INFINITY; count];
    };
    let weights = fit.expand(problem.design.width);
    let mut meat = DMatrix::zeros(count, count);
    for score in problem.scores(&weights) {
        let own = complement.project(&score);
        meat.ger(1.0, &own, &own, 1.0);
    }
    let blocks = &inverse * meat * &inverse;
    (0..count).map(|k| inverse[(k, k)].max(blocks[(k, k)]).max(0.0).sqrt()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 1e-4 rad/(N m) is 10000 N m/rad.
    #[test]
    fn a_weight_is_read_as_the_parameter_that_people_know() {
        let name = |kind: EffectKind, (index, _): (usize, Option<f64>)| {
            kind.entry().parameters[index].name
        };
        let (kind, found) = (EffectKind::JointElasticity, Some(1e-4));
        let (index, size) = parameter_of(kind, 0, found);
        assert_eq!(name(kind, (index, size)), "stiffness");
        assert!((size.unwrap() / 1e4 - 1.0).abs() < 1e-12);
        let parameter_name = |kind| name(kind, parameter_of(kind, 0, found));
        assert_eq!(parameter_name(EffectKind::StribeckFriction), "breakaway");
        assert_eq!(parameter_name(EffectKind::PreslidingFriction), "level");
        assert_eq!(parameter_of(EffectKind::Payload, 2, found), (2, found));
        assert_eq!(parameter_of(EffectKind::JointElasticity, 0, None), (0, None));
    }
}
