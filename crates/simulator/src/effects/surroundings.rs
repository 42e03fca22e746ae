use nalgebra::Vector3;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, UnitSphere};
use robot::Robot;

/// Where an effect is drawn, and how large motion and torque are there without it.
#[derive(Debug, Clone, Copy)]
pub struct Surroundings<'a> {
    /// The robot without effects.
    pub robot: &'a Robot,
    /// The joint, or the joint that carries the link.
    pub joint: usize,
    /// Root mean square of the joint's torque (N m or N).
    pub torque_rms: f64,
    /// Root mean square of its velocity (rad/s or m/s).
    pub speed_rms: f64,
    /// Root mean square of its acceleration (rad/s² or m/s²).
    pub acceleration_rms: f64,
    /// Least and largest position (rad or m).
    pub range: (f64, f64),
    /// Root mean square of the derivative of its torque (N m/s or N/s).
    pub torque_rate_rms: f64,
    /// What it turns, all other joints free (kg m² or kg).
    pub inertia: f64,
    /// How large torque and motion of every joint of the arm are, in its order.
    pub joints: &'a [JointLevel],
}

/// How large torque and motion of a joint are.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JointLevel {
    /// Root mean square of its torque (N m or N).
    pub torque_rms: f64,
    /// Root mean square of its velocity (rad/s or m/s).
    pub speed_rms: f64,
}

impl Surroundings<'_> {
    /// Name of the joint.
    pub fn joint_name(&self) -> String {
        self.robot.joint_names().nth(self.joint).unwrap_or_default().to_owned()
    }

    /// Name of the link that the joint carries.
    pub fn link_name(&self) -> String {
        self.robot.links().get(self.joint).map_or_else(String::new, |l| l.name.clone())
    }

    /// Name of the last link that the joint carries.
    pub(crate) fn tip_name(&self) -> String {
        let mut tip = self.joint;
        for (i, link) in self.robot.links().iter().enumerate() {
            if link.parent == Some(tip) {
                tip = i;
            }
        }
        Self { joint: tip, ..*self }.link_name()
    }

    /// Acceleration of free fall (m/s²), at least 1, so that a weightless arm has a payload too.
    pub(crate) fn fall(&self) -> f64 {
        self.robot.gravity_in_base().norm().max(1.0)
    }

    /// How steeply the torque follows the position (N m/rad or N/m): `d torque / dq`.
    pub(crate) fn torque_per_position(&self) -> f64 {
        self.torque_rate_rms / self.speed_rms.max(1e-9)
    }
}

/// A direction without preference.
pub(crate) fn direction(random: &mut ChaCha8Rng) -> Vector3<f64> {
    Vector3::from(UnitSphere.sample(random))
}
