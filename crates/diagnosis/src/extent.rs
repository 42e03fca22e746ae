use logs::Prepared;
use robot::{Joint, Robot};

/// Range of motion below which a joint counts as unmoved, as a share of its limits' span
/// or of a full turn.
const UNMOVED_SHARE: f64 = 0.02;

/// Why the logs can say nothing of a joint, for every joint of which that is so.
pub(crate) fn inadequate(robot: &Robot, prepared: &Prepared) -> Vec<Option<String>> {
    let reason = |(j, link): (usize, &robot::Link)| {
        let (range, least) = (range(prepared, j), UNMOVED_SHARE * full_range(&link.joint));
        if range <= least {
            let unit = if link.joint.kind.is_rotation() { "rad" } else { "m" };
            return Some(format!(
                "the joint moves over {range:.4} {unit} in these logs, at least {least:.3} are needed"
            ));
        }
        let constant = prepared.runs.iter().find(|r| {
            let effort = &r.joints[j].effort;
            effort.iter().all(|e| (e - effort[0]).abs() <= f64::EPSILON * effort[0].abs())
        })?;
        Some(format!("its effort never changes in {}: it was not recorded there", constant.name))
    };
    robot.links().iter().enumerate().map(reason).collect()
}

/// Range of motion of joint `j` over all runs (rad or m).
pub(crate) fn range(prepared: &Prepared, j: usize) -> f64 {
    let (low, high) = prepared.span(j);
    high - low
}

/// The span of a joint's limits, at most a full turn (rad); one metre for a prismatic
/// joint without limits.
fn full_range(joint: &Joint) -> f64 {
    let unlimited = if joint.kind.is_rotation() { std::f64::consts::TAU } else { 1.0 };
    joint.limits.position.map_or(unlimited, |(low, high)| (high - low).min(unlimited))
}
