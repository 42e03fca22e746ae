use effects::{Frame, Scale};
use logs::{Prepared, PreparedJoint, rest_speeds};
use robot::{Joint, Robot};

/// Range of motion below which a joint counts as unmoved, as a share of its limits' span
/// or of a full turn.
const UNMOVED_SHARE: f64 = 0.02;

/// What the columns of all runs are made in.
pub(crate) fn frame(prepared: &Prepared) -> Frame {
    let centre = |j| {
        let (low, high) = span(prepared, j);
        0.5 * (low + high)
    };
    let rest_speed = rest_speeds(prepared);
    Frame { centre: (0..rest_speed.len()).map(centre).collect(), rest_speed }
}

/// How large things are in the logs.
pub(crate) fn scale(robot: &Robot, prepared: &Prepared) -> Scale {
    let all = 0..joints(prepared);
    let links = robot.links();
    let lengths = links.iter().map(|l| l.joint.parent_from_joint.translation.vector.norm());
    let masses = links.iter().map(|l| l.inertia.mass.max(0.0));
    let n = links.len() as f64;
    Scale {
        effort: all.clone().map(|j| rms(prepared, j, |p| &p.effort)).collect(),
        speed: all.clone().map(|j| largest(prepared, j, |p| &p.qd)).collect(),
        acceleration: all.clone().map(|j| largest(prepared, j, |p| &p.qdd)).collect(),
        range: all.map(|j| range(prepared, j)).collect(),
        link_mass: masses.sum::<f64>() / n,
        link_length: (lengths.sum::<f64>() / n).max(0.05),
    }
}

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
    let (low, high) = span(prepared, j);
    high - low
}

/// The span of a joint's limits, at most a full turn (rad); one metre for a prismatic
/// joint without limits.
fn full_range(joint: &Joint) -> f64 {
    let unlimited = if joint.kind.is_rotation() { std::f64::consts::TAU } else { 1.0 };
    joint.limits.position.map_or(unlimited, |(low, high)| (high - low).min(unlimited))
}

fn joints(prepared: &Prepared) -> usize {
    prepared.runs.first().map_or(0, |r| r.joints.len())
}

fn signal<'a>(
    prepared: &'a Prepared,
    j: usize,
    pick: impl Fn(&PreparedJoint) -> &Vec<f64> + 'a,
) -> impl Iterator<Item = f64> + 'a {
    prepared.runs.iter().flat_map(move |r| pick(&r.joints[j]).iter().copied())
}

fn span(prepared: &Prepared, j: usize) -> (f64, f64) {
    let q = signal(prepared, j, |p| &p.q);
    q.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), q| (l.min(q), h.max(q)))
}

fn largest(prepared: &Prepared, j: usize, pick: fn(&PreparedJoint) -> &Vec<f64>) -> f64 {
    signal(prepared, j, pick).fold(0.0, |m, x| m.max(x.abs()))
}

fn rms(prepared: &Prepared, j: usize, pick: fn(&PreparedJoint) -> &Vec<f64>) -> f64 {
    let (n, sum) = signal(prepared, j, pick).fold((0, 0.0), |(n, s), x| (n + 1, s + x * x));
    (sum / f64::from(n.max(1))).sqrt()
}
