use nalgebra::Vector3;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, UnitSphere};
use robot::Robot;

/// Largest dry friction of a drive (N m or N).
pub(crate) const MOST_DRY: f64 = 1000.0;

/// The joint at which an effect is drawn, with its motion and torque without the effect.
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
    /// Its apparent inertia with all other joints free (kg m² or kg).
    pub inertia: f64,
    /// Torque and speed of every joint, in the order of the arm.
    pub joints: &'a [JointLevel],
}

/// Torque and speed of a joint.
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

    /// Dry friction of a share of the joint's torque, at most that of a drive (N m or N).
    pub(crate) fn dry(&self, share: f64) -> f64 {
        (share * self.torque_rms).min(MOST_DRY)
    }

    /// Magnitude of gravity (m/s²), at least 1, so that a payload can be sized for a weightless arm.
    pub(crate) fn fall(&self) -> f64 {
        self.robot.gravity_in_base().norm().max(1.0)
    }

    /// Slope of the torque over the position (N m/rad or N/m): `d torque / dq`.
    pub(crate) fn torque_per_position(&self) -> f64 {
        self.torque_rate_rms / self.speed_rms.max(1e-9)
    }
}

/// A uniformly distributed direction.
pub(crate) fn direction(random: &mut ChaCha8Rng) -> Vector3<f64> {
    Vector3::from(UnitSphere.sample(random))
}
