//! Robots for the tests of this crate.

use effects::Frame;
use logs::{Prepared, PreparedJoint, PreparedRun};
use robot::Robot;

use crate::motion_record::MotionRecord;

/// Rate of [`log`] (Hz).
pub(crate) const RATE_HZ: f64 = 100.0;

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

/// A log of one sine at every joint with the torque of the robot as described and, at the
/// last joint, `extra(qd)`.
pub(crate) fn log(robot: &Robot, extra: impl Fn(f64) -> f64) -> Prepared {
    let joints = robot.joint_count();
    let w = std::f64::consts::TAU * 0.25;
    let wave = |derivative: i32| -> Vec<f64> {
        let quarter = f64::from(derivative) * std::f64::consts::FRAC_PI_2;
        let at = |k: u32| 0.3 * w.powi(derivative) * (w * f64::from(k) / RATE_HZ + quarter).sin();
        (0..3000).map(at).collect()
    };
    let state = [wave(0), wave(1), wave(2)];
    let mut run = PreparedRun {
        name: "run".to_owned(),
        rate_hz: RATE_HZ,
        time: (0..state[0].len()).map(|k| k as f64 / RATE_HZ).collect(),
        session_start_s: 0.0,
        joints: Vec::new(),
    };
    let joint = PreparedJoint::exact(state, vec![0.0; 3000]);
    run.joints = vec![joint; joints];
    let frame = Frame {
        rest_speed: vec![1e-3; joints],
        centre: vec![0.0; joints],
        reach: vec![1.0; joints],
        resolution: vec![0.0; joints],
        trial_gaps: vec![0.0; joints],
        trial_springs: vec![None; joints],
        trial_lateness_s: 0.0,
    };
    let motion = MotionRecord::of_run(&run, 1).evaluate(robot, &frame);
    for (joint, effort) in run.joints.iter_mut().zip(&motion.effort) {
        joint.effort.clone_from(effort);
    }
    let last = &mut run.joints[joints - 1];
    last.effort.iter_mut().zip(&last.qd).for_each(|(e, v)| *e += extra(*v));
    Prepared::exact(vec![run], 4.0)
}
