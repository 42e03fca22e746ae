use catalogue::EffectKind;
use effects::{Hypothesis, Place};
use robot::Robot;

use crate::outcome::effect_at::effect_at;
use crate::result::{Estimate, Finding};
use crate::signals::limit::Limit;

/// A limit as a finding.
pub(crate) fn limit_finding(robot: &Robot, limit: &Limit) -> Finding {
    let kind = EffectKind::TorqueSaturation;
    let parameter = &kind.entry().parameters[0];
    let link = &robot.links()[limit.joint];
    let rotation = link.joint.kind.is_rotation();
    Finding {
        at: effect_at(robot, Hypothesis { kind, place: Place::Joint(limit.joint) }),
        parameters: vec![Estimate {
            name: parameter.name,
            value: limit.limit,
            ci95: limit.ci95,
            noise95: limit.ci95,
            nominal: link.joint.limits.effort.unwrap_or(f64::INFINITY),
            unit: if rotation { parameter.unit } else { parameter.unit_prismatic },
            determined: true,
        }],
        share_explained: limit.share,
        log_evidence: limit.log_evidence,
        held_out_gain: limit.share,
        not_separable_from: Vec::new(),
        told_apart_by: None,
        evidence: vec![format!(
            "the effort beyond the limit moves nothing: it is {:.0} % of what all other effects leave at the joint",
            100.0 * limit.share
        )],
        undetermined: Vec::new(),
    }
}
