use diagnosis::{EffectAt, Finding};
use robot::Robot;

use crate::diagnosis::report::Report;

/// Units of the signals of one joint, as they are printed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct JointUnits {
    pub position: &'static str,
    pub velocity: &'static str,
    pub effort: &'static str,
    /// One-sided spectral density of the effort.
    pub density: &'static str,
    /// What the effort is: `torque` or `force`.
    pub load: &'static str,
}

impl JointUnits {
    /// The units of the joint with this name; those of a rotation when there is none.
    pub fn of(robot: &Robot, joint: &str) -> Self {
        let index = robot.joint_index(joint);
        let is_rotation =
            index.and_then(|i| robot.links().get(i)).is_none_or(|l| l.joint.kind.is_rotation());
        if is_rotation {
            Self {
                position: "rad",
                velocity: "rad/s",
                effort: "N·m",
                density: "(N·m)²/Hz",
                load: "torque",
            }
        } else {
            Self { position: "m", velocity: "m/s", effort: "N", density: "N²/Hz", load: "force" }
        }
    }

    /// A sentence in which an effort has the unit `N m`, with the unit of this joint.
    pub fn with_unit(self, sentence: &str) -> String {
        sentence.replace("N m", self.effort)
    }
}

/// Name of the place of a joint in a page, by its index.
pub(crate) fn joint_anchor(joint: usize) -> String {
    format!("joint-{}", joint + 1)
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

/// The findings at one joint; with `None`, those of links and of the whole robot, which
/// change the effort of several.
pub(crate) fn findings_of<'a>(report: &Report<'a>, joint: Option<&str>) -> Vec<&'a Finding> {
    report.diagnosis.findings.iter().filter(|f| f.at.joint.as_deref() == joint).collect()
}

/// The findings that change the effort of one joint: its own, those of its link and of the
/// links that it carries, those of the whole robot.
pub(crate) fn acting_on<'a>(report: &Report<'a>, joint: usize) -> Vec<&'a Finding> {
    let name = report.diagnosis.joints.get(joint).map(|j| j.name.as_str());
    let links = report.robot.links();
    let carries = |link: &str| {
        let start = links.iter().position(|l| l.name == link);
        let mut outward = std::iter::successors(start, |&i| links.get(i)?.parent);
        outward.any(|i| links.get(i).is_some_and(|l| Some(l.joint.name.as_str()) == name))
    };
    let acts = |at: &EffectAt| match (&at.joint, &at.link) {
        (Some(at), _) => Some(at.as_str()) == name,
        (None, Some(link)) => carries(link),
        (None, None) => true,
    };
    report.diagnosis.findings.iter().filter(|f| acts(&f.at)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sample;

    #[test]
    fn a_joint_feels_the_links_that_it_carries_and_no_other_joint() {
        let sample = sample::arm();
        let words = |joint| -> Vec<String> {
            acting_on(&sample.report(), joint).iter().map(|f| f.at.words()).collect()
        };
        let of_link = "IN02 inertial parameters at elbow_link";
        assert_eq!(words(0), ["FR02 Coulomb friction at shoulder", of_link]);
        assert_eq!(words(1), [of_link]);
    }

    #[test]
    fn a_sliding_joint_has_forces() {
        let mut links = sample::arm().robot.links().to_vec();
        links[1].joint.kind = robot::JointKind::Prismatic;
        let robot = Robot::new("arm", nalgebra::Vector3::zeros(), links).unwrap();
        assert_eq!(JointUnits::of(&robot, "elbow").with_unit("0.4 N m RMS"), "0.4 N RMS");
        assert_eq!(JointUnits::of(&robot, "shoulder").with_unit("0.4 N m RMS"), "0.4 N·m RMS");
        let densities = ["elbow", "shoulder"].map(|joint| JointUnits::of(&robot, joint).density);
        assert_eq!(densities, ["N²/Hz", "(N·m)²/Hz"]);
    }
}
