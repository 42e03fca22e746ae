use diagnosis::{EffectAt, Finding};
use robot::Robot;

use crate::Report;

/// Units of the signals of one joint, as they are printed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct JointUnits {
    pub position: &'static str,
    pub velocity: &'static str,
    pub effort: &'static str,
}

impl JointUnits {
    /// The units of the joint with this name; those of a rotation when there is none.
    pub fn of(robot: &Robot, joint: &str) -> Self {
        let index = robot.joint_index(joint);
        let is_rotation =
            index.and_then(|i| robot.links().get(i)).is_none_or(|l| l.joint.kind.is_rotation());
        if is_rotation {
            Self { position: "rad", velocity: "rad/s", effort: "N·m" }
        } else {
            Self { position: "m", velocity: "m/s", effort: "N" }
        }
    }
}

/// Index of the joint where an effect acts; none when it acts on the whole robot.
pub(crate) fn joint_of(report: &Report, at: &EffectAt) -> Option<usize> {
    let by_joint = at.joint.as_deref();
    let by_link = at.link.as_deref().and_then(|name| {
        let link = report.robot.links().iter().find(|l| l.name == name)?;
        Some(link.joint.name.as_str())
    });
    let name = by_joint.or(by_link)?;
    report.diagnosis.joints.iter().position(|j| j.name == name)
}

/// The findings of one joint and of its link; with `None`, those of the whole robot.
pub(crate) fn findings_of<'a>(report: &Report<'a>, joint: Option<usize>) -> Vec<&'a Finding> {
    let all = report.diagnosis.findings.iter();
    all.filter(|f| joint_of(report, &f.at) == joint).collect()
}

/// Names as they stand in a sentence: `a`, `a and b`, `a, b and c`.
pub(crate) fn listed(names: &[String]) -> String {
    match names {
        [] => String::new(),
        [only] => only.clone(),
        [first @ .., last] => format!("{} and {last}", first.join(", ")),
    }
}

/// `1 effect`, `3 effects`.
pub(crate) fn counted(count: usize, noun: &str) -> String {
    if count == 1 { format!("1 {noun}") } else { format!("{count} {noun}s") }
}
