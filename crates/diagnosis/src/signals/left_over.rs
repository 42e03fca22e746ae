use effects::Frame;
use logs::{LogError, Prepared};
use robot::{Robot, TorqueSource};

use crate::signals::along::Along;
use crate::signals::limit::Limit;
use crate::thresholds::signals::SignalThresholds;

/// Measured efforts of one run minus those of a robot, `[joint][sample]`, in the band of the motion and
/// at a rate of 2.5 cut-off frequencies (N m or N).
#[derive(Debug, Clone, PartialEq)]
pub struct LeftOver {
    /// The efforts of the log, after the low-pass.
    pub measured: Vec<Vec<f64>>,
    /// The same minus the efforts that the robot needs for the motion, after the same low-pass.
    pub left: Vec<Vec<f64>>,
}

/// Evaluates `robot` along the motion of some logs, as a diagnosis does:
///
/// ```text
/// left = L(clamp(effort, -limit, limit) - effort of the robot),   measured = L(effort)
/// ```
///
/// with the drives as they are described. Their delays, encoder errors and elastic transmissions are no functions of
/// the state `q, qd, qdd` ([`effects::RunMotion`]). The limit is that of the joint; measured efforts have none, since
/// they are torque. Joints count as at rest below `rest_speed` (rad/s or m/s).
///
/// # Errors
///
/// [`LogError`] for runs whose rate allows no low-pass.
///
/// # Panics
///
/// When robot, `rest_speed` and logs differ in their number of joints.
pub fn unexplained_torque(
    robot: &Robot,
    rest_speed: &[f64],
    logs: &Prepared,
) -> Result<Vec<LeftOver>, LogError> {
    let limits = described_limits(robot);
    let thresholds = SignalThresholds::default();
    let frame = Frame { rest_speed: rest_speed.to_vec(), ..Frame::of_logs(logs) };
    let of = |run| {
        let along = Along::new(robot, &frame, run, logs.cutoff_hz, &limits, &thresholds)?;
        Ok(of_run(&along))
    };
    logs.runs.iter().map(of).collect()
}

/// The residual of the robot of `along`, from the efforts that became torque.
fn of_run(along: &Along) -> LeftOver {
    let measured = along.measured_effort();
    let mut left = along.remaining_effort(&measured);
    for (left, beyond) in left.iter_mut().zip(along.beyond_limits()) {
        left.iter_mut().zip(beyond).for_each(|(left, beyond)| *left -= beyond);
    }
    LeftOver { measured, left }
}

/// The described limits of drives whose efforts are commands.
fn described_limits(robot: &Robot) -> Vec<Limit> {
    let limit = |(joint, link): (usize, &robot::Link)| {
        // A URDF that knows no limit often states one of zero.
        let limit = link.joint.limits.effort.filter(|limit| *limit > 0.0)?;
        let is_command = link.actuator.torque_source != TorqueSource::Measured;
        is_command.then_some(Limit {
            joint,
            limit,
            ci95: [limit; 2],
            share: 0.0,
            log_evidence: 0.0,
        })
    };
    robot.links().iter().enumerate().filter_map(limit).collect()
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use logs::{PreparedJoint, PreparedRun};

    use super::*;

    const RATE_HZ: f64 = 500.0;
    const INERTIA: f64 = 0.5;
    const LIMIT_NM: f64 = 20.0;

    /// A wheel that gravity does not turn.
    fn wheel() -> Robot {
        Robot::from_urdf(&format!(
            r#"<robot name="wheel"><link name="base"/><link name="rim"><inertial><mass value="1"/>
              <inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="{INERTIA}"/></inertial></link>
            <joint name="joint" type="revolute"><parent link="base"/><child link="rim"/>
              <axis xyz="0 0 1"/>
              <limit lower="-9" upper="9" velocity="9" effort="{LIMIT_NM}"/></joint></robot>"#
        ))
        .unwrap()
    }

    /// A log of 10 s of the motion and effort that are given at a time.
    fn log(motion: impl Fn(f64) -> [f64; 3], effort: impl Fn(f64) -> f64) -> Prepared {
        let time: Vec<f64> = (0..5000).map(|k| f64::from(k) / RATE_HZ).collect();
        let state = [0, 1, 2].map(|i| time.iter().map(|t| motion(*t)[i]).collect());
        let effort = time.iter().map(|t| effort(*t)).collect();
        let joints = vec![PreparedJoint::exact(state, effort)];
        let run = PreparedRun {
            name: "run".to_owned(),
            rate_hz: RATE_HZ,
            time,
            session_start_s: 0.0,
            joints,
        };
        Prepared::exact(vec![run], 10.0)
    }

    /// The largest of the middle of what is left, and of the effort there.
    fn largest(robot: &Robot, log: &Prepared) -> [f64; 2] {
        let of = &unexplained_torque(robot, &[0.01], log).unwrap()[0];
        [&of.left[0], &of.measured[0]].map(|x| {
            let middle = &x[x.len() / 4..3 * x.len() / 4];
            middle.iter().fold(0.0, |most: f64, x| most.max(x.abs()))
        })
    }

    /// What is asked for at a time turns the wheel a delay later: at 1 Hz 20 ms of it are
    /// `2 sin(w delay / 2) = 0.125` of the torque.
    #[test]
    fn oracle_a_late_torque_is_left_where_the_robot_knows_of_no_delay() {
        let (delay_s, omega) = (0.02, TAU);
        let at = |t: f64| {
            let (sin, cos) = (omega * t).sin_cos();
            [sin, omega * cos, -omega * omega * sin]
        };
        let log = log(at, |t| INERTIA * at(t + delay_s)[2]);
        let mut robot = wheel();
        let [left, measured] = largest(&robot, &log);
        let share = 2.0 * (0.5 * omega * delay_s).sin();
        assert!((left / measured - share).abs() < 1e-3, "{left} of {measured}");
        robot.link_mut(0).unwrap().actuator.delay_s = delay_s;
        let [left, measured] = largest(&robot, &log);
        assert!(left < 1e-3 * measured, "{left} of {measured}");
    }

    /// A wheel at rest against a stop: 50 N m are asked for, and 20 N m are there.
    #[test]
    fn oracle_of_a_command_what_is_beyond_the_limit_is_no_torque() {
        let log = log(|_| [0.0; 3], |_| 50.0);
        let mut robot = wheel();
        for (source, expected) in
            [(TorqueSource::Commanded, LIMIT_NM), (TorqueSource::Measured, 50.0)]
        {
            robot.link_mut(0).unwrap().actuator.torque_source = source;
            let [left, measured] = largest(&robot, &log);
            assert!((left - expected).abs() < 1e-6, "{left} of {measured}, {source:?}");
            assert!((measured - 50.0).abs() < 1e-6);
        }
    }
}
