use effects::Hypothesis;
use robot::Robot;

use crate::result::EffectAt;

/// An effect and its place by name.
pub(crate) fn effect_at(robot: &Robot, hypothesis: Hypothesis) -> EffectAt {
    let link = |i: usize| robot.links().get(i);
    EffectAt {
        effect: hypothesis.kind,
        joint: hypothesis.joint().and_then(link).map(|l| l.joint.name.clone()),
        link: hypothesis.link().and_then(link).map(|l| l.name.clone()),
    }
}
