use dynamics::{Dynamics, PARAMETERS_PER_LINK};
use nalgebra::{UnitVector3, Vector3};
use robot::{Actuator, Robot};

/// The motion of one run and what the nominal robot makes of it.
///
/// All signals are indexed `[joint][sample]`.
#[derive(Debug, Clone)]
pub struct Motion {
    /// Position (rad or m).
    pub q: Vec<Vec<f64>>,
    /// Velocity (rad/s or m/s).
    pub qd: Vec<Vec<f64>>,
    /// Acceleration (rad/s² or m/s²).
    pub qdd: Vec<Vec<f64>>,
    /// Direction of motion, in [-1, 1]: the sign of the velocity, in proportion to it below
    /// the rest speed.
    pub direction: Vec<Vec<f64>>,
    /// Torque of the nominal robot before its gain and offset (N·m or N).
    pub torque: Vec<Vec<f64>>,
    /// Effort that the nominal robot expects in the log (N·m or N).
    pub effort: Vec<Vec<f64>>,
    /// Middle of the range of each joint over all runs (rad or m).
    pub centre: Vec<f64>,
    /// Reported effort per unit of torque, nominal.
    pub gain: Vec<f64>,
    /// `[joint][link]` to the ten regressor signals, empty where the joint does not carry the link.
    pub(crate) regressor: Vec<Vec<Vec<Vec<f64>>>>,
    /// `[joint][tilt]`: torque per radian of tilt about the two horizontal axes.
    pub(crate) tilt: Vec<[Vec<f64>; 2]>,
}

/// What all runs of a diagnosis share.
#[derive(Debug, Clone, PartialEq)]
pub struct Frame {
    /// Speed below which a joint counts as at rest (rad/s or m/s).
    pub rest_speed: Vec<f64>,
    /// Middle of the range of each joint over all runs (rad or m).
    pub centre: Vec<f64>,
}

impl Motion {
    /// Evaluates the nominal robot along `q`, `qd`, `qdd` (each `[joint][sample]`), with
    /// directions from `swift`, a velocity that is filtered less.
    ///
    /// ```text
    /// torque = Y pi + rotor_inertia qdd + viscous qd + coulomb(direction) + stiffness (q - rest)
    /// effort = torque_gain torque + torque_offset
    /// ```
    ///
    /// # Panics
    ///
    /// When the signals do not have one entry a joint of equal length.
    pub fn new(
        robot: &Robot,
        frame: &Frame,
        [q, qd, qdd]: [Vec<Vec<f64>>; 3],
        swift: &[Vec<f64>],
    ) -> Self {
        let direction = swift
            .iter()
            .zip(&frame.rest_speed)
            .map(|(v, rest)| v.iter().map(|v| (v / rest).clamp(-1.0, 1.0)).collect())
            .collect();
        let joints = robot.joint_count();
        let gain = robot.links().iter().map(|l| l.actuator.torque_gain).collect();
        let mut motion = Self {
            q,
            qd,
            qdd,
            direction,
            torque: vec![Vec::new(); joints],
            effort: vec![Vec::new(); joints],
            centre: frame.centre.clone(),
            gain,
            regressor: Vec::new(),
            tilt: Vec::new(),
        };
        motion.rigid_body(robot);
        motion.drives(robot);
        motion
    }

    /// Number of samples.
    pub fn samples(&self) -> usize {
        self.q.first().map_or(0, Vec::len)
    }

    /// Fills the regressor, the tilt signals and the rigid-body torque.
    fn rigid_body(&mut self, robot: &Robot) {
        let (n, samples) = (robot.joint_count(), self.samples());
        let width = PARAMETERS_PER_LINK * n;
        let carries = carries(robot);
        let signals = |i: usize, j: usize| {
            let count = if carries[i][j] { PARAMETERS_PER_LINK } else { 0 };
            vec![vec![0.0; samples]; count]
        };
        self.regressor = (0..n).map(|i| (0..n).map(|j| signals(i, j)).collect()).collect();
        self.tilt = vec![[vec![0.0; samples], vec![0.0; samples]]; n];
        self.torque = vec![vec![0.0; samples]; n];
        let pi: Vec<f64> = robot.links().iter().flat_map(|l| l.inertia.parameters()).collect();
        let gravity = robot.gravity_in_base();
        let turned = tilt_axes(gravity).map(|axis| axis.cross(&gravity));
        let dynamics = Dynamics::new(robot);
        let mut ws = dynamics.workspace();
        let (mut y, mut g) = (vec![0.0; n * width], vec![0.0; 3 * n]);
        let mut state = [vec![0.0; n], vec![0.0; n], vec![0.0; n]];
        for t in 0..samples {
            for (x, signal) in state.iter_mut().zip([&self.q, &self.qd, &self.qdd]) {
                x.iter_mut().zip(signal).for_each(|(x, s)| *x = s[t]);
            }
            dynamics.torque_regressor_into(&mut ws, &state[0], &state[1], &state[2], &mut y);
            dynamics.gravity_regressor_into(&mut ws, &state[0], &mut g);
            for i in 0..n {
                let row = &y[i * width..(i + 1) * width];
                self.torque[i][t] = row.iter().zip(&pi).map(|(y, p)| y * p).sum();
                for (j, block) in self.regressor[i].iter_mut().enumerate() {
                    let entries = &row[j * PARAMETERS_PER_LINK..];
                    block.iter_mut().zip(entries).for_each(|(signal, y)| signal[t] = *y);
                }
                let weight = Vector3::from_row_slice(&g[3 * i..3 * i + 3]);
                self.tilt[i].iter_mut().zip(&turned).for_each(|(s, v)| s[t] = weight.dot(v));
            }
        }
    }

    /// Adds what the drives do, then gain and offset.
    fn drives(&mut self, robot: &Robot) {
        for (i, link) in robot.links().iter().enumerate() {
            let a = &link.actuator;
            for (t, torque) in self.torque[i].iter_mut().enumerate() {
                let state = [self.q[i][t], self.qd[i][t], self.qdd[i][t]];
                *torque += drive_torque(a, state, self.direction[i][t]);
            }
            let reported = |torque: &f64| a.torque_gain * torque + a.torque_offset;
            self.effort[i] = self.torque[i].iter().map(reported).collect();
        }
    }
}

/// Torque that a joint's drive needs beside the rigid bodies (N·m or N), in the state
/// `q, qd, qdd` and with `direction` of motion in [-1, 1]:
///
/// ```text
/// rotor_inertia qdd + viscous qd + coulomb(direction) + stiffness (q - rest)
/// ```
pub fn drive_torque(drive: &Actuator, [q, qd, qdd]: [f64; 3], direction: f64) -> f64 {
    motor_torque(drive, [qd, qdd], direction) + spring_torque(drive, q)
}

/// The part of the drive's torque that is spent at the motor (N·m or N).
pub(crate) fn motor_torque(drive: &Actuator, [qd, qdd]: [f64; 2], direction: f64) -> f64 {
    let level = if direction > 0.0 { drive.coulomb_forward } else { drive.coulomb_backward };
    drive.rotor_inertia * qdd + drive.viscous * qd + level * direction
}

/// The part of the drive's torque that is spent at the link (N·m or N).
pub(crate) fn spring_torque(drive: &Actuator, q: f64) -> f64 {
    drive.spring_stiffness * (q - drive.spring_rest)
}

/// Two horizontal axes, unit vectors orthogonal to gravity and to each other.
pub(crate) fn tilt_axes(gravity: Vector3<f64>) -> [Vector3<f64>; 2] {
    let down = UnitVector3::try_new(gravity, 1e-9).unwrap_or_else(|| -Vector3::z_axis());
    // The base axis that is most nearly horizontal starts the pair: x for an upright arm.
    let start = if down.x.abs() < 0.9 { Vector3::x() } else { Vector3::y() };
    let first = (start - down.into_inner() * down.dot(&start)).normalize();
    [first, (-down.into_inner()).cross(&first)]
}

/// `[joint][link]`: whether the joint carries the link.
fn carries(robot: &Robot) -> Vec<Vec<bool>> {
    let n = robot.joint_count();
    let carriers = |link: usize| -> Vec<usize> {
        std::iter::successors(Some(link), |&at| robot.links()[at].parent).collect()
    };
    let carriers: Vec<Vec<usize>> = (0..n).map(carriers).collect();
    (0..n).map(|joint| carriers.iter().map(|c| c.contains(&joint)).collect()).collect()
}
