use std::path::Path;

use motion::{MotionError, MotionSpec, State};
use rand_chacha::ChaCha8Rng;
use robot::Robot;

use crate::arms::arm::SampledArm;
use crate::dice::between;
use crate::rigid::torque;

/// Share of a position range that motions use.
const POSITION_SHARE: f64 = 0.85;
/// Share of a speed limit that motions use.
const SPEED_SHARE: f64 = 0.85;
/// Share of a torque limit for bodies and rotors; the rest is for friction and feedback.
const TORQUE_SHARE: f64 = 0.55;
/// Largest torque over position gain: the static position error of a joint (rad, m).
const LARGEST_SAG: [f64; 2] = [0.08, 0.03];
/// Time between checks of a motion (s).
const LOOK_S: f64 = 0.02;
/// Motion at one joint: peak speed and acceleration of a glide of length and duration 1.
const GLIDE: [f64; 2] = [1.875, 5.774];

/// Limits of the motions of an arm.
#[derive(Debug, Clone)]
pub(crate) struct Ground<'a> {
    arm: &'a SampledArm,
    /// Names of the joints.
    pub names: Vec<String>,
    /// Middle of each joint's range (rad or m).
    pub middle: Vec<f64>,
    /// Half of what is used of it (rad or m).
    pub half: Vec<f64>,
    /// Speeds of the motion (rad/s or m/s).
    pub speed: Vec<f64>,
    /// Accelerations of the motion (rad/s^2 or m/s^2).
    pub acceleration: Vec<f64>,
    /// Speed over the limits', 0 to 1.
    pub pace: f64,
}

impl<'a> Ground<'a> {
    /// For motions at `pace` of what the arm can.
    pub(crate) fn new(arm: &'a SampledArm, pace: f64) -> Self {
        let joints = || arm.robot.links().iter().map(|link| &link.joint);
        let range = |j: &robot::Joint| j.limits.position.unwrap_or((-1.0, 1.0));
        let fastest = |j: &robot::Joint| j.limits.velocity.unwrap_or(1.0);
        Self {
            arm,
            names: joints().map(|j| j.name.clone()).collect(),
            middle: joints().map(|j| 0.5 * (range(j).0 + range(j).1)).collect(),
            half: joints().map(|j| 0.5 * POSITION_SHARE * (range(j).1 - range(j).0)).collect(),
            speed: joints().map(|j| SPEED_SHARE * pace * fastest(j)).collect(),
            acceleration: arm.accelerations.iter().map(|a| pace * a).collect(),
            pace,
        }
    }

    /// The same with smaller ways, speeds and accelerations.
    pub(crate) fn smaller(&self, scale: f64) -> Self {
        let less = |values: &[f64]| values.iter().map(|v| scale * v).collect();
        Self {
            half: less(&self.half),
            speed: less(&self.speed),
            acceleration: less(&self.acceleration),
            pace: scale * self.pace,
            ..self.clone()
        }
    }

    /// Number of joints.
    pub(crate) fn count(&self) -> usize {
        self.names.len()
    }

    /// A posture anywhere in the ranges.
    pub(crate) fn posture(&self, random: &mut ChaCha8Rng) -> Vec<f64> {
        let ranges = self.middle.iter().zip(&self.half);
        ranges.map(|(middle, half)| middle + half * between(random, [-1.0, 1.0])).collect()
    }

    /// The nearest posture in the ranges.
    pub(crate) fn clamp(&self, posture: &[f64]) -> Vec<f64> {
        let ranges = self.middle.iter().zip(&self.half);
        ranges.zip(posture).map(|((m, h), q)| q.clamp(m - h, m + h)).collect()
    }

    /// Time in which all joints get from one posture to another (s).
    pub(crate) fn glide_s(&self, from: &[f64], to: &[f64]) -> f64 {
        let joints = from.iter().zip(to).zip(self.speed.iter().zip(&self.acceleration));
        let needed = joints.map(|((a, b), (v, most))| glide_s((a - b).abs(), *v, *most));
        needed.fold(0.2, f64::max)
    }

    /// The robot that moves.
    pub(crate) fn robot(&self) -> &Robot {
        &self.arm.robot
    }

    /// Length of a motion that the arm can follow (s): it stays in position, speed and torque, and its loop stays
    /// near. `None` of any other.
    pub(crate) fn feasible_length_s(&self, spec: &MotionSpec) -> Result<Option<f64>, MotionError> {
        let robot = self.robot();
        let motion = match spec.build(robot, Path::new("")) {
            Err(MotionError::LimitExceeded { .. }) => return Ok(None),
            other => other?,
        };
        let looks = (motion.duration_s() / LOOK_S).ceil() as usize;
        let mut state = State::default();
        for look in 0..=looks {
            motion.sample(look as f64 * LOOK_S, &mut state);
            let tau = torque(robot, &state.q, &state.qd, &state.qdd);
            let joints = tau.iter().zip(self.arm.limits.iter().zip(&self.arm.kp));
            for (link, (tau, (limit, kp))) in robot.links().iter().zip(joints) {
                let sag = LARGEST_SAG[usize::from(!link.joint.kind.is_rotation())];
                if tau.abs() > TORQUE_SHARE * limit || tau.abs() > sag * kp {
                    return Ok(None);
                }
            }
        }
        Ok(Some(motion.duration_s()))
    }
}

/// Time of a glide over a way within a speed and an acceleration (s).
pub(crate) fn glide_s(way: f64, speed: f64, acceleration: f64) -> f64 {
    (GLIDE[0] * way / speed).max((GLIDE[1] * way / acceleration).sqrt())
}
