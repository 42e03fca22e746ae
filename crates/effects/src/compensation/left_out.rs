use catalogue::EffectKind;
use robot::{Actuator, Robot};

use crate::model::{MODELLED, model};

/// The order in which a sentence names effects; any other comes after these.
const FIRST: [EffectKind; 9] = [
    EffectKind::Backlash,
    EffectKind::JointElasticity,
    EffectKind::ActuatorDelay,
    EffectKind::PreslidingFriction,
    EffectKind::DifferentialCoupling,
    EffectKind::ActuatorLag,
    EffectKind::EncoderOffset,
    EffectKind::TransmissionRatio,
    EffectKind::TimeSkew,
];

/// Described effects that a torque from one state leaves out, one sentence a joint: effects that need the past, the
/// motion of the other side of a transmission, or other times.
///
/// Their share of the effort counts as if it were not described. A measured effort contains delay and lag already.
pub fn omissions(robot: &Robot) -> Vec<String> {
    let sentence = |(name, drive): (&str, &Actuator)| {
        let keys = keys(drive).join(" and ");
        (!keys.is_empty()).then(|| {
            format!(
                "{name}: the expected effort leaves out {keys} of the robot; what this does to \
                 the log is treated as if the robot did not say it"
            )
        })
    };
    let drives = robot.links().iter().map(|l| (l.joint.name.as_str(), &l.actuator));
    drives.filter_map(sentence).collect()
}

/// Keys of `robot.toml` of the effects of `drive` that are left out.
fn keys(drive: &Actuator) -> Vec<&'static str> {
    let others = MODELLED.into_iter().filter(|kind| !FIRST.contains(kind));
    let kinds = FIRST.into_iter().chain(others);
    kinds.filter_map(|kind| model(kind).ok()?.omission(drive)).collect()
}

#[cfg(test)]
mod tests {
    use robot::{Coupling, TorqueSource};

    use super::*;

    #[test]
    fn every_joint_with_a_key_that_is_left_out_is_named_with_it() {
        let joint = |name: &str, parent: &str, child: &str| {
            format!(
                r#"<link name="{child}"><inertial><mass value="1"/><inertia ixx="1" ixy="0"
                ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link><joint name="{name}"
                type="continuous"><parent link="{parent}"/><child link="{child}"/></joint>"#
            )
        };
        let joints = joint("shoulder", "base", "upper") + &joint("elbow", "upper", "lower");
        let urdf = format!(r#"<robot name="arm"><link name="base"/>{joints}</robot>"#);
        let mut robot = Robot::from_urdf(&urdf).unwrap();
        assert_eq!(omissions(&robot), [""; 0]);
        let drive = &mut robot.link_mut(1).unwrap().actuator;
        (drive.backlash, drive.delay_s) = (0.001, 0.002);
        let expected = "elbow: the expected effort leaves out backlash_rad and actuator_delay_ms \
                        of the robot; what this does to the log is treated as if the robot did \
                        not say it";
        assert_eq!(omissions(&robot), [expected]);
        robot.link_mut(1).unwrap().actuator.torque_source = TorqueSource::Measured;
        assert_eq!(omissions(&robot), [expected.replace(" and actuator_delay_ms", "")]);
        robot.link_mut(0).unwrap().actuator.elasticity = Some(100.0);
        assert_eq!(omissions(&robot).len(), 2);
    }

    #[test]
    fn all_that_a_drive_can_say_beyond_the_expected_effort_is_named() {
        let urdf = r#"<robot name="arm"><link name="base"/><link name="a"><inertial>
            <mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>
            </link><joint name="j" type="continuous"><parent link="base"/><child link="a"/>
            </joint></robot>"#;
        type Describe = fn(&mut Actuator);
        let cases: [(&str, Describe); 6] = [
            ("coupling", |a| {
                let [level, viscous] = [[0.1; 2], [0.0; 2]];
                a.coupling = Some(Coupling { other: 0, ratio: 1.0, level, viscous });
            }),
            ("presliding_rad", |a| a.presliding = Some(0.001)),
            ("actuator_lag_ms", |a| a.lag_s = 0.001),
            ("encoder_offset_rad", |a| a.encoder_offset = -0.1),
            ("transmission_ratio", |a| a.transmission_ratio = 0.9),
            ("effort_skew_ms", |a| a.effort_skew_s = -0.001),
        ];
        for (key, describe) in cases {
            let mut robot = Robot::from_urdf(urdf).unwrap();
            describe(&mut robot.link_mut(0).unwrap().actuator);
            let start = format!("j: the expected effort leaves out {key} of the robot;");
            assert!(omissions(&robot)[0].starts_with(&start), "{key}");
        }
    }
}
