use logs::{Prepared, PreparedJoint, PreparedRun};
use robot::Robot;

/// Magnitudes in a set of logs that scale the priors of the weights.
#[derive(Debug, Clone, PartialEq)]
pub struct Scale {
    /// RMS of the measured effort of each joint, or its described friction if that is larger (N·m or N). The prior
    /// then allows a fit to remove a described friction far larger than the effort.
    pub effort: Vec<f64>,
    /// Largest speed of each joint (rad/s or m/s).
    pub speed: Vec<f64>,
    /// Largest acceleration of each joint (rad/s² or m/s²).
    pub acceleration: Vec<f64>,
    /// Range of motion of each joint (rad or m).
    pub range: Vec<f64>,
    /// Longest time since drives were cold (s).
    pub session_s: f64,
    /// Mean mass of a moving link (kg).
    pub link_mass: f64,
    /// Mean distance between neighbouring joints (m).
    pub link_length: f64,
}

impl Scale {
    /// The magnitudes in some logs.
    pub fn of_logs(robot: &Robot, logs: &Prepared) -> Self {
        let joints = 0..robot.joint_count();
        let all = |j: usize, pick: fn(&PreparedJoint) -> &Vec<f64>| {
            logs.runs.iter().flat_map(move |run: &PreparedRun| pick(&run.joints[j]).iter().copied())
        };
        let largest = |j, pick| all(j, pick).fold(0.0, |m: f64, x| m.max(x.abs()));
        let rms = |j, pick| {
            let (n, sum) = all(j, pick).fold((0, 0.0), |(n, s), x| (n + 1, s + x * x));
            (sum / f64::from(n.max(1))).sqrt()
        };
        let effort = |j: usize| {
            let drive = &robot.links()[j].actuator;
            let level = drive.coulomb_forward.max(drive.coulomb_backward);
            let friction = level + drive.viscous * largest(j, |p| &p.qd);
            let gain = drive.transmission_ratio * drive.torque_gain;
            rms(j, |p| &p.effort).max(gain.abs() * friction)
        };
        let range = |j| {
            let (low, high) = logs.span(j);
            high - low
        };
        let ages =
            logs.runs.iter().map(|run| run.time.last().map_or(0.0, |t| t - run.session_start_s));
        let [link_mass, link_length] = Self::of_links(robot);
        Self {
            effort: joints.clone().map(effort).collect(),
            speed: joints.clone().map(|j| largest(j, |p| &p.qd)).collect(),
            acceleration: joints.clone().map(|j| largest(j, |p| &p.qdd)).collect(),
            range: joints.map(range).collect(),
            session_s: ages.fold(0.0, f64::max),
            link_mass,
            link_length,
        }
    }

    /// Mean mass of a moving link (kg) and mean distance between neighbouring joints, at least
    /// 0.05 (m).
    pub fn of_links(robot: &Robot) -> [f64; 2] {
        let links = robot.links();
        let n = links.len().max(1) as f64;
        let lengths = links.iter().map(|l| l.joint.parent_from_joint.translation.vector.norm());
        let mass = links.iter().map(|l| l.inertia.mass.max(0.0)).sum::<f64>() / n;
        [mass, (lengths.sum::<f64>() / n).max(0.05)]
    }

    /// Effort of `joint` per unit of `of`, zero for a joint that did not move.
    pub(crate) fn effort_per(&self, joint: usize, of: &[f64]) -> f64 {
        let unit = of.get(joint).copied().unwrap_or(0.0);
        let effort = self.effort.get(joint).copied().unwrap_or(0.0);
        if unit > 0.0 { effort / unit } else { 0.0 }
    }
}
