use nalgebra::{Rotation3, Vector3};
use robot::{Inertia, Robot};

/// What lies between motor and link of a joint.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Transmission {
    /// Torque per unit of deflection (N m/rad or N/m); `None` for a rigid one.
    pub stiffness: Option<f64>,
    /// Torque per unit of deflection velocity (N m s/rad or N s/m).
    pub damping: f64,
    /// Free play between motor and link, full width (rad or m).
    pub gap: f64,
}

impl Transmission {
    /// Whether motor and link move as one.
    pub fn is_rigid(&self) -> bool {
        self.stiffness.is_none() && self.gap <= 0.0
    }
}

/// What the simulated arm is made of, before the engine is built from it.
///
/// The robot's actuators count: `viscous`, `coulomb_forward`, `coulomb_backward` and
/// `rotor_inertia` act at the motor, the spring at the link, gain and offset in the drive:
/// `effort = torque_gain tau + torque_offset`.
#[derive(Debug, Clone, PartialEq)]
pub struct Plant {
    /// Links, joints, actuators, gravity.
    pub robot: Robot,
    /// One a joint.
    pub transmissions: Vec<Transmission>,
}

impl Plant {
    /// The robot as described, every transmission rigid.
    pub fn new(robot: Robot) -> Self {
        let transmissions = vec![Transmission::default(); robot.joint_count()];
        Self { robot, transmissions }
    }

    /// Fixes a body, given in the frame of the link, to a link.
    pub fn attach(&mut self, link: usize, body: &Inertia) {
        if let Some(link) = self.robot.link_mut(link) {
            link.inertia = link.inertia.merged_with(body);
        }
    }

    /// Turns gravity by a rotation vector in the frame of the base (rad), as a tilted base does.
    pub fn tilt(&mut self, rotation_in_base: Vector3<f64>) {
        let gravity = Rotation3::new(rotation_in_base) * self.robot.gravity_in_base();
        self.robot = self.robot.clone().with_gravity(gravity);
    }
}
