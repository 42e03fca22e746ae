//! Robots for the tests of this crate.

use robot::Robot;

/// One joint that turns about the vertical: no gravity, no limits but those of the joint.
pub(crate) fn turntable() -> Robot {
    Robot::from_urdf(
        r#"<robot name="table"><link name="base"/>
  <link name="plate"><inertial><mass value="2"/>
    <inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.02"/></inertial></link>
  <joint name="turn" type="revolute"><parent link="base"/><child link="plate"/>
    <axis xyz="0 0 1"/><limit lower="-1" upper="2" velocity="3" effort="50"/></joint></robot>"#,
    )
    .unwrap()
}

/// Two level hinges, one behind the other: gravity reaches both.
pub(crate) fn arm() -> Robot {
    Robot::from_urdf(
        r#"<robot name="arm"><link name="base"/>
  <link name="upper"><inertial><origin xyz="0.2 0 0"/><mass value="3"/>
    <inertia ixx="0.01" iyy="0.05" izz="0.05" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <link name="fore"><inertial><origin xyz="0.15 0 0"/><mass value="2"/>
    <inertia ixx="0.01" iyy="0.03" izz="0.03" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <joint name="shoulder" type="revolute"><parent link="base"/><child link="upper"/>
    <axis xyz="0 -1 0"/><limit lower="-2.9" upper="2.9" effort="40" velocity="6"/></joint>
  <joint name="elbow" type="revolute"><parent link="upper"/><child link="fore"/>
    <origin xyz="0.4 0 0"/><axis xyz="0 -1 0"/>
    <limit lower="-2.9" upper="2.9" effort="20" velocity="6"/></joint></robot>"#,
    )
    .unwrap()
}
