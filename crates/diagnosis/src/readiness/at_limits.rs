use logs::Prepared;
use robot::Robot;

use crate::thresholds::readiness::ReadinessThresholds;

/// Warnings about joints whose effort is at the described limit for much of the logs. There an arm does not follow
/// its motion, and often vibrates.
pub(crate) fn at_limits(
    robot: &Robot,
    prepared: &Prepared,
    t: &ReadinessThresholds,
) -> Vec<String> {
    let warning = |(j, link): (usize, &robot::Link)| {
        let limit = link.joint.limits.effort.filter(|limit| *limit > 0.0)?;
        let efforts = || prepared.runs.iter().flat_map(|run| &run.joints[j].effort);
        let near = efforts().filter(|effort| effort.abs() >= t.at_limit_from * limit).count();
        let share = near as f64 / efforts().count().max(1) as f64;
        let unit = if link.joint.kind.is_rotation() { "N·m" } else { "N" };
        (share >= t.at_limit_share).then(|| {
            format!(
                "{}: its effort is at the limit of {limit} {unit} in {:.0} % of the samples: the \
                 motion asks for more than the drive has",
                link.joint.name,
                100.0 * share
            )
        })
    };
    robot.links().iter().enumerate().filter_map(warning).collect()
}

#[cfg(test)]
mod tests {
    use logs::{PreparedJoint, PreparedRun};

    use super::*;

    /// A drive of 2 N m, and 200 samples of which so many are near it, on either side of zero.
    fn warnings_for(near: usize) -> Vec<String> {
        let robot = Robot::from_urdf(
            r#"<robot name="r"><link name="base"/><link name="rim"/>
            <joint name="joint" type="revolute"><parent link="base"/><child link="rim"/>
            <axis xyz="0 0 1"/><limit lower="-9" upper="9" velocity="9" effort="2"/></joint></robot>"#,
        )
        .unwrap();
        let effort = (0..200).map(|k| match k {
            k if k >= near => 1.8,
            k if k % 2 == 0 => 1.95,
            _ => -2.05,
        });
        let joints = vec![PreparedJoint::exact([vec![], vec![], vec![]], effort.collect())];
        let time = (0..200).map(f64::from).collect();
        let run = PreparedRun {
            name: "run".to_owned(),
            rate_hz: 1.0,
            time,
            session_start_s: 0.0,
            joints,
        };
        at_limits(&robot, &Prepared::exact(vec![run], 0.1), &ReadinessThresholds::default())
    }

    #[test]
    fn an_effort_at_its_limit_is_told_from_one_that_is_there_for_a_moment() {
        let expected = "joint: its effort is at the limit of 2 N·m in 40 % of the samples: the \
                        motion asks for more than the drive has";
        assert_eq!(warnings_for(80), [expected]);
        assert_eq!(warnings_for(1), Vec::<String>::new());
    }
}
