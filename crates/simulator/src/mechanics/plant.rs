use nalgebra::{Rotation3, Vector3};
use robot::{Inertia, Robot};

use crate::mechanics::transmission::Transmission;

/// The model from which the engine is built.
///
/// Of the robot's actuators, `viscous`, `coulomb_forward`, `coulomb_backward` and `rotor_inertia`
/// act at the motor, the spring at the link, and gain and offset in the drive:
/// `effort = torque_gain tau + torque_offset`. Every other property of an actuator acts like the
/// effect of the same name: friction beyond the Coulomb level, presliding and ripple at the motor,
/// delay and lag on the command, ratio and encoder offset on the reported position. Presliding
/// without a stated damping has half of critical damping.
#[derive(Debug, Clone, PartialEq)]
pub struct Plant {
    /// Links, joints, actuators, gravity.
    pub robot: Robot,
    /// One per joint.
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
            link.inertia = link.inertia.with_body(body);
        }
    }

    /// Turns gravity by a rotation vector in the frame of the base (rad), as a tilted base does.
    pub fn tilt(&mut self, rotation_in_base: Vector3<f64>) {
        let gravity = Rotation3::new(rotation_in_base) * self.robot.gravity_in_base();
        self.robot = self.robot.clone().with_gravity(gravity);
    }
}
