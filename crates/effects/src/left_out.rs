use robot::{Actuator, Robot, TorqueSource};

/// What the robot says of its drives and the expected effort along a log leaves out, one
/// sentence a joint.
///
/// Free play, twist and delay are states that would have to be followed along the log; what they
/// do to the effort counts as something that the robot does not say. An effort that was measured
/// has the delay behind it.
pub fn left_out(robot: &Robot) -> Vec<String> {
    let sentence = |(name, drive): (&str, &Actuator)| {
        let measured =
            matches!(drive.torque_source, TorqueSource::Measured | TorqueSource::Current);
        let said = [
            ("backlash_rad", drive.backlash > 0.0),
            ("elasticity_nm_per_rad", drive.elasticity.is_some()),
            ("actuator_delay_ms", drive.delay_s > 0.0 && !measured),
        ];
        let keys: Vec<&str> = said.iter().filter(|(_, is)| *is).map(|(key, _)| *key).collect();
        let keys = keys.join(" and ");
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

#[cfg(test)]
mod tests {
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
        assert_eq!(left_out(&robot), [""; 0]);
        let drive = &mut robot.link_mut(1).unwrap().actuator;
        (drive.backlash, drive.delay_s) = (0.001, 0.002);
        let expected = "elbow: the expected effort leaves out backlash_rad and actuator_delay_ms \
                        of the robot; what this does to the log is treated as if the robot did \
                        not say it";
        assert_eq!(left_out(&robot), [expected]);
        robot.link_mut(1).unwrap().actuator.torque_source = TorqueSource::Measured;
        assert_eq!(left_out(&robot), [expected.replace(" and actuator_delay_ms", "")]);
        robot.link_mut(0).unwrap().actuator.elasticity = Some(100.0);
        assert_eq!(left_out(&robot).len(), 2);
    }
}
