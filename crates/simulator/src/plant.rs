use nalgebra::{Rotation3, Vector3};
use robot::{Actuator, Inertia, Robot};

/// Damping of a described transmission as a share of critical damping against the rotor: the
/// description has no key for it. Cable drives and harmonic gears have 0.5 to 5 %.
const DAMPING_RATIO: f64 = 0.02;

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
    /// What the description says of a joint: its stiffness, its free play, and a damping of 2 %
    /// of critical.
    pub fn described(actuator: &Actuator) -> Self {
        let inertia = actuator.rotor_inertia;
        let damping = |stiffness| damping(DAMPING_RATIO, stiffness, inertia);
        Self {
            stiffness: actuator.elasticity,
            damping: actuator.elasticity.map_or(0.0, damping),
            gap: actuator.backlash,
        }
    }

    /// How far the link stays behind its motor under a load that rests on it (rad or m), as a
    /// negative number for a positive load:
    ///
    /// ```text
    /// q - theta = -(load / stiffness + (gap / 2) sign(load))
    /// ```
    pub(crate) fn twist_under(&self, load: f64) -> f64 {
        if load.abs() <= 0.0 {
            return 0.0;
        }
        -(self.stiffness.map_or(0.0, |k| load / k) + 0.5 * self.gap.copysign(load))
    }

    /// Whether motor and link move as one.
    pub fn is_rigid(&self) -> bool {
        self.stiffness.is_none() && self.gap <= 0.0
    }
}

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
        let described = robot.links().iter().map(|l| Transmission::described(&l.actuator));
        Self { transmissions: described.collect(), robot }
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

/// Damping (N m s/rad or N s/m) that is `ratio` of critical for a rotor on a spring:
///
/// ```text
/// d = 2 ratio sqrt(k J)
/// ```
pub(crate) fn damping(ratio: f64, stiffness: f64, rotor_inertia: f64) -> f64 {
    2.0 * ratio * (stiffness * rotor_inertia.max(0.0)).sqrt()
}
