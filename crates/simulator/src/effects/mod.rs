//! The truth side of every effect, one file each, named as in the catalogue.

pub(crate) mod actuator_delay;
pub(crate) mod actuator_lag;
pub(crate) mod asymmetric_friction;
pub(crate) mod backlash;
pub(crate) mod cable_spring;
pub(crate) mod coulomb_friction;
pub(crate) mod counterbalance;
pub(crate) mod described;
pub(crate) mod differential_coupling;
pub(crate) mod encoder_offset;
pub(crate) mod external_disturbance;
pub(crate) mod friction_temperature_drift;
pub(crate) mod gravity_direction;
pub(crate) mod inertial_parameters;
pub(crate) mod joint_elasticity;
pub(crate) mod load_dependent_friction;
pub(crate) mod payload;
pub(crate) mod position_dependent_friction;
pub(crate) mod presliding_friction;
pub(crate) mod rotor_inertia;
pub(crate) mod spec;
pub(crate) mod stribeck_friction;
pub(crate) mod time_skew;
pub(crate) mod torque_constant;
pub(crate) mod torque_offset;
pub(crate) mod torque_ripple;
pub(crate) mod torque_saturation;
pub(crate) mod transmission_ratio;
pub(crate) mod viscous_friction;

use catalogue::EffectKind;
use nalgebra::Vector3;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, UnitSphere};
use robot::Robot;

pub use actuator_delay::ActuatorDelay;
pub use actuator_lag::ActuatorLag;
pub use asymmetric_friction::AsymmetricFriction;
pub use backlash::Backlash;
pub use cable_spring::{CableSpring, Pulls};
pub use coulomb_friction::CoulombFriction;
pub use counterbalance::Counterbalance;
pub(crate) use described::described;
pub use differential_coupling::DifferentialCoupling;
pub use encoder_offset::EncoderOffset;
pub use external_disturbance::ExternalDisturbance;
pub use friction_temperature_drift::FrictionTemperatureDrift;
pub use gravity_direction::GravityDirection;
pub(crate) use gravity_direction::horizontal;
pub use inertial_parameters::InertialParameters;
pub use joint_elasticity::JointElasticity;
pub use load_dependent_friction::LoadDependentFriction;
pub use payload::Payload;
pub use position_dependent_friction::PositionDependentFriction;
pub use presliding_friction::PreslidingFriction;
pub use rotor_inertia::RotorInertia;
pub use spec::EffectSpec;
pub use stribeck_friction::StribeckFriction;
pub use time_skew::TimeSkew;
pub use torque_constant::TorqueConstant;
pub use torque_offset::TorqueOffset;
pub use torque_ripple::TorqueRipple;
pub use torque_saturation::TorqueSaturation;
pub use transmission_ratio::TransmissionRatio;
pub use viscous_friction::ViscousFriction;

use crate::inject::Inject;
use crate::truth::Truth;

/// A value of a scenario that cannot be meant.
#[derive(Debug, Clone, PartialEq)]
pub struct Mistake {
    /// Key of the value, inside the effect.
    pub key: &'static str,
    /// What was found and what was expected.
    pub found: String,
}

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
    fn tip_name(&self) -> String {
        let mut tip = self.joint;
        for (i, link) in self.robot.links().iter().enumerate() {
            if link.parent == Some(tip) {
                tip = i;
            }
        }
        Self { joint: tip, ..*self }.link_name()
    }

    /// Acceleration of free fall (m/s²), at least 1, so that a weightless arm has a payload too.
    fn fall(&self) -> f64 {
        self.robot.gravity_in_base().norm().max(1.0)
    }

    /// How steeply the torque follows the position (N m/rad or N/m): `d torque / dq`.
    pub(crate) fn torque_per_position(&self) -> f64 {
        self.torque_rate_rms / self.speed_rms.max(1e-9)
    }
}

/// An effect as a scenario states it.
pub trait Effect: Sized {
    /// Its name.
    const KIND: EffectKind;

    /// Where it acts, and its parameters under the catalogue's names.
    fn truth(&self) -> Truth;

    /// The effect ready to act on a robot. Refuses what no arm has; the joints and links named
    /// must be the robot's.
    ///
    /// # Errors
    ///
    /// [`Mistake`], the first found.
    fn inject(&self, robot: &Robot) -> Result<Box<dyn Inject>, Mistake>;

    /// An effect whose torque has about `share` of the joint's torque root mean square, and more
    /// the larger `share` is; what does not set the size is drawn.
    fn draw(at: &Surroundings<'_>, share: f64, random: &mut ChaCha8Rng) -> Self;
}

/// Place of an effect in the chain from command to motion: its hooks run in this order.
///
/// Commands are limited, held back and lagged before they become torque; what scales friction
/// comes after every friction.
pub(crate) fn chain_rank(kind: EffectKind) -> usize {
    use EffectKind as K;
    match kind {
        K::TorqueSaturation => 0,
        K::ActuatorDelay => 1,
        K::ActuatorLag => 2,
        K::TransmissionRatio => 3,
        K::TorqueRipple => 4,
        K::FrictionTemperatureDrift => 6,
        _ => 5,
    }
}

/// The index of a joint that a scenario names.
pub(crate) fn joint_of(robot: &Robot, name: &str) -> Result<usize, Mistake> {
    robot.joint_index(name).ok_or_else(|| {
        let names: Vec<&str> = robot.joint_names().collect();
        let hint = hint("joints", name, &names);
        let found = format!("no joint of robot {} is called {name}, {hint}", robot.name());
        Mistake { key: "joint", found }
    })
}

/// The index of a moving link that a scenario names.
fn link_of(robot: &Robot, name: &str) -> Result<usize, Mistake> {
    let links = robot.links();
    if let Some(index) = links.iter().position(|l| l.name == name) {
        return Ok(index);
    }
    let found = match links.iter().find(|l| l.merged.iter().any(|m| m == name)) {
        Some(link) => format!("{name} is fixed to {0}, {0} was expected", link.name),
        None => {
            let names: Vec<&str> = links.iter().map(|l| l.name.as_str()).collect();
            let hint = hint("moving links", name, &names);
            format!("no moving link of robot {} is called {name}, {hint}", robot.name())
        }
    };
    Err(Mistake { key: "link", found })
}

/// The name that was meant, else all there are.
fn hint(things: &str, name: &str, names: &[&str]) -> String {
    document::suggest(name, names.iter().copied()).map_or_else(
        || format!("its {things} are {}", names.join(", ")),
        |near| format!("did you mean {near}?"),
    )
}

/// Refuses a number outside of `low..=high`.
pub(crate) fn within(key: &'static str, value: f64, low: f64, high: f64) -> Result<(), Mistake> {
    if value.is_finite() && (low..=high).contains(&value) {
        return Ok(());
    }
    let found = format!("{value}, a number from {low} to {high} was expected");
    Err(Mistake { key, found })
}

/// A direction without preference.
fn direction(random: &mut ChaCha8Rng) -> Vector3<f64> {
    Vector3::from(UnitSphere.sample(random))
}
