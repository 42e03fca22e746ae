use nalgebra::{Rotation3, Vector3};
use robot::{Inertia, Robot};

use crate::mechanics::transmission::Transmission;

/// What the simulated arm is made of, before the engine is built from it.
///
/// The robot's actuators count: `viscous`, `coulomb_forward`, `coulomb_backward` and
/// `rotor_inertia` act at the motor, the spring at the link, gain and offset in the drive:
/// `effort = torque_gain tau + torque_offset`. What else the actuators say acts as the effect of
/// the same name would: friction beyond the Coulomb level, presliding and ripple at the motor,
/// delay and lag on the way of the command, ratio and offset of the encoder in what is reported.
/// Bristles of presliding whose damping is not said are damped with half of critical damping.
#[derive(Debug, Clone, PartialEq)]
pub struct Plant {
    /// Links, joints, actuators, gravity.
    pub robot: Robot,
    /// One a joint.
    pub transmissions: Vec<Transmission>,
}

impl Plant {
    /// The robot as described.
    pub fn new(robot: Robot) -> Self {
        let described = robot.links().iter().map(|l| Transmission::of_actuator(&l.actuator));
        Self { transmissions: described.collect(), robot }
    }

    /// Fixes a body, given in the frame of the link, to a link.
    pub fn attach(&mut self, link: usize, body: &Inertia) {
        if let Some(link) = self.robot.link_mut(link) {
            link.inertia = link.inertia.plus(body);
        }
    }

    /// Turns gravity by a rotation vector in the frame of the base (rad), as a tilted base does.
    pub fn tilt(&mut self, rotation_in_base: Vector3<f64>) {
        let gravity = Rotation3::new(rotation_in_base) * self.robot.gravity_in_base();
        self.robot = self.robot.clone().with_gravity(gravity);
    }
}
