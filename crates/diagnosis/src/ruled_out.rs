use nalgebra::DMatrix;

use crate::findings::{Evidence, effect_at};
use crate::fit::{Complement, Fit};
use crate::problem::Problem;
use crate::result::RuledOut;

/// Standard errors at which an effect would be found in four cases of five by a test at
/// level 0.005, two-sided: 2.81 + 0.84.
const DETECTED_AT: f64 = 3.65;

/// Share of the prior's standard deviation beyond which a log is said to show nothing.
const SHOWS_NOTHING: f64 = 0.5;

impl Evidence<'_> {
    /// Every hypothesis that is no finding, with the smallest size that would have been one.
    pub fn ruled_out(&self) -> Vec<RuledOut> {
        let problem = self.selection.problem;
        let Some(fit) = problem.fit(self.model) else { return Vec::new() };
        let outside = (0..problem.design.groups.len()).filter(|g| !self.model.contains(g));
        outside.map(|g| self.one(g, &fit)).collect()
    }

    fn one(&self, g: usize, fit: &Fit) -> RuledOut {
        let (problem, robot) = (self.selection.problem, self.selection.robot);
        let group = &problem.design.groups[g];
        let parameter = &group.hypothesis.kind.entry().parameters[0];
        let rotation =
            group.hypothesis.joint().is_none_or(|j| robot.links()[j].joint.kind.is_rotation());
        let (smallest_detectable, because) = self.judge(g, fit);
        RuledOut {
            at: effect_at(robot, group.hypothesis),
            parameter: parameter.name,
            smallest_detectable,
            unit: if rotation { parameter.unit } else { parameter.unit_prismatic },
            because,
        }
    }

    fn judge(&self, g: usize, fit: &Fit) -> (Option<f64>, String) {
        let problem = self.selection.problem;
        let columns = problem.new_columns(self.model, g);
        let Some(&main) = columns.first() else {
            return (None, "a finding already changes the same numbers".to_owned());
        };
        let complement = fit.complement(&problem.info, &columns, &problem.design.prior);
        let sd = standard_error(problem, fit, &complement);
        if sd > SHOWS_NOTHING * problem.design.prior[main] {
            return (None, "these logs cannot show it".to_owned());
        }
        let mut larger = self.model.clone();
        larger.insert(g);
        let gain = fit.evidence_of(&problem.info, &columns, &problem.design.prior);
        let p = self.significance.p[g].map_or_else(String::new, |p| format!(", p = {p:.3}"));
        let because = if !self.selection.is_possible(&larger, g) {
            "its best size is not physically possible".to_owned()
        } else if gain < 3.0 {
            format!("it adds {gain:.1} to the log evidence, 3 are needed{p}")
        } else {
            format!("it adds nothing on held-out data that counts{p}")
        };
        (Some(DETECTED_AT * sd), because)
    }
}

/// Standard error of the first weight of a group that is not in the model: the larger of
/// what the likelihood and what the scatter of the blocks' scores say.
fn standard_error(problem: &Problem, fit: &Fit, complement: &Complement) -> f64 {
    let Some(inverse) = complement.b.clone().try_inverse() else { return f64::INFINITY };
    let weights = fit.expand(problem.design.width);
    let mut meat = DMatrix::zeros(inverse.nrows(), inverse.nrows());
    for &b in &problem.of {
        let score = complement.project(&problem.grams.score(b, &problem.weight, &weights));
        meat.ger(1.0, &score, &score, 1.0);
    }
    let blocks = &inverse * meat * &inverse;
    inverse[(0, 0)].max(blocks[(0, 0)]).max(0.0).sqrt()
}
