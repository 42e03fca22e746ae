//! The truth side of every effect, one file each, named as in the catalogue.

mod actuator_delay;
mod actuator_lag;
mod asymmetric_friction;
mod backlash;
mod cable_spring;
mod coulomb_friction;
mod differential_coupling;
mod encoder_offset;
mod external_disturbance;
mod friction_temperature_drift;
mod gravity_direction;
mod inertial_parameters;
mod joint_elasticity;
mod load_dependent_friction;
mod payload;
mod position_dependent_friction;
mod presliding_friction;
mod rotor_inertia;
mod stribeck_friction;
mod time_skew;
mod torque_constant;
mod torque_offset;
mod torque_ripple;
mod torque_saturation;
mod transmission_ratio;
mod viscous_friction;

use catalogue::EffectKind;
use nalgebra::Vector3;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, UnitSphere};
use robot::Robot;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

pub use actuator_delay::ActuatorDelay;
pub use actuator_lag::ActuatorLag;
pub use asymmetric_friction::AsymmetricFriction;
pub use backlash::Backlash;
pub use cable_spring::{CableSpring, Pulls};
pub use coulomb_friction::CoulombFriction;
pub use differential_coupling::DifferentialCoupling;
pub use encoder_offset::EncoderOffset;
pub use external_disturbance::ExternalDisturbance;
pub use friction_temperature_drift::FrictionTemperatureDrift;
pub use gravity_direction::GravityDirection;
pub use inertial_parameters::InertialParameters;
pub use joint_elasticity::JointElasticity;
pub use load_dependent_friction::LoadDependentFriction;
pub use payload::Payload;
pub use position_dependent_friction::PositionDependentFriction;
pub use presliding_friction::PreslidingFriction;
pub use rotor_inertia::RotorInertia;
pub use stribeck_friction::StribeckFriction;
pub use time_skew::TimeSkew;
pub use torque_constant::TorqueConstant;
pub use torque_offset::TorqueOffset;
pub use torque_ripple::TorqueRipple;
pub use torque_saturation::TorqueSaturation;
pub use transmission_ratio::TransmissionRatio;
pub use viscous_friction::ViscousFriction;

use crate::{Inject, Truth};

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
    fn torque_per_position(&self) -> f64 {
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

/// Any effect, as `[[effect]]` of a scenario states it: one key, the effect's name.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum EffectSpec {
    /// Torque against the motion in proportion to velocity.
    ViscousFriction(ViscousFriction),
    /// Torque of constant size against the motion.
    CoulombFriction(CoulombFriction),
    /// Dry friction with one level for each direction.
    AsymmetricFriction(AsymmetricFriction),
    /// Dry friction that is larger at rest.
    StribeckFriction(StribeckFriction),
    /// Dry friction that gives like a spring before it slides.
    PreslidingFriction(PreslidingFriction),
    /// Dry friction that grows with the torque carried.
    LoadDependentFriction(LoadDependentFriction),
    /// Dry friction that varies with position.
    PositionDependentFriction(PositionDependentFriction),
    /// Friction that falls while the drive warms up.
    FrictionTemperatureDrift(FrictionTemperatureDrift),
    /// Free play between motor and link.
    Backlash(Backlash),
    /// A spring with damping between motor and link.
    JointElasticity(JointElasticity),
    /// Inertia of the motor beyond the description.
    RotorInertia(RotorInertia),
    /// Dry friction at the two motors of a differential.
    DifferentialCoupling(DifferentialCoupling),
    /// A body fixed to a link.
    Payload(Payload),
    /// What a link truly weighs.
    InertialParameters(InertialParameters),
    /// A base that does not stand as described.
    GravityDirection(GravityDirection),
    /// A hose or cable that pulls at a joint.
    CableSpring(CableSpring),
    /// Torque of the motor that its angle decides.
    TorqueRipple(TorqueRipple),
    /// Effort in a wrong unit of torque.
    TorqueConstant(TorqueConstant),
    /// A constant in the reported effort.
    TorqueOffset(TorqueOffset),
    /// Torque that follows its command as through a filter.
    ActuatorLag(ActuatorLag),
    /// Torque that comes a fixed time after its command.
    ActuatorDelay(ActuatorDelay),
    /// A drive that gives no more than its limit.
    TorqueSaturation(TorqueSaturation),
    /// An encoder whose zero is not the joint's.
    EncoderOffset(EncoderOffset),
    /// A gear ratio that is not the one the drive was told.
    TransmissionRatio(TransmissionRatio),
    /// Effort and position of different instants in one row.
    TimeSkew(TimeSkew),
    /// A torque or force from the world around.
    ExternalDisturbance(ExternalDisturbance),
}

/// Calls a function of [`Effect`] on whichever effect it is.
macro_rules! each {
    ($spec:expr, $effect:ident => $call:expr) => {
        match $spec {
            EffectSpec::ViscousFriction($effect) => $call,
            EffectSpec::CoulombFriction($effect) => $call,
            EffectSpec::AsymmetricFriction($effect) => $call,
            EffectSpec::StribeckFriction($effect) => $call,
            EffectSpec::PreslidingFriction($effect) => $call,
            EffectSpec::LoadDependentFriction($effect) => $call,
            EffectSpec::PositionDependentFriction($effect) => $call,
            EffectSpec::FrictionTemperatureDrift($effect) => $call,
            EffectSpec::Backlash($effect) => $call,
            EffectSpec::JointElasticity($effect) => $call,
            EffectSpec::RotorInertia($effect) => $call,
            EffectSpec::DifferentialCoupling($effect) => $call,
            EffectSpec::Payload($effect) => $call,
            EffectSpec::InertialParameters($effect) => $call,
            EffectSpec::GravityDirection($effect) => $call,
            EffectSpec::CableSpring($effect) => $call,
            EffectSpec::TorqueRipple($effect) => $call,
            EffectSpec::TorqueConstant($effect) => $call,
            EffectSpec::TorqueOffset($effect) => $call,
            EffectSpec::ActuatorLag($effect) => $call,
            EffectSpec::ActuatorDelay($effect) => $call,
            EffectSpec::TorqueSaturation($effect) => $call,
            EffectSpec::EncoderOffset($effect) => $call,
            EffectSpec::TransmissionRatio($effect) => $call,
            EffectSpec::TimeSkew($effect) => $call,
            EffectSpec::ExternalDisturbance($effect) => $call,
        }
    };
}

impl EffectSpec {
    /// Its name.
    pub fn kind(&self) -> EffectKind {
        each!(self, effect => kind_of(effect))
    }

    /// Where it acts, and its parameters under the catalogue's names.
    pub fn truth(&self) -> Truth {
        each!(self, effect => effect.truth())
    }

    /// The effect ready to act on a robot; see [`Effect::inject`].
    ///
    /// # Errors
    ///
    /// [`Mistake`], the first found: a joint that the robot does not have, or a value that no arm
    /// has.
    pub fn inject(&self, robot: &Robot) -> Result<Box<dyn Inject>, Mistake> {
        each!(self, effect => effect.inject(robot))
    }

    /// An effect of a kind, drawn; see [`Effect::draw`].
    pub fn draw(
        kind: EffectKind,
        at: &Surroundings<'_>,
        share: f64,
        random: &mut ChaCha8Rng,
    ) -> Option<Self> {
        match kind {
            EffectKind::ViscousFriction => {
                Some(Self::ViscousFriction(Effect::draw(at, share, random)))
            }
            EffectKind::CoulombFriction => {
                Some(Self::CoulombFriction(Effect::draw(at, share, random)))
            }
            EffectKind::AsymmetricFriction => {
                Some(Self::AsymmetricFriction(Effect::draw(at, share, random)))
            }
            EffectKind::StribeckFriction => {
                Some(Self::StribeckFriction(Effect::draw(at, share, random)))
            }
            EffectKind::PreslidingFriction => {
                Some(Self::PreslidingFriction(Effect::draw(at, share, random)))
            }
            EffectKind::LoadDependentFriction => {
                Some(Self::LoadDependentFriction(Effect::draw(at, share, random)))
            }
            EffectKind::PositionDependentFriction => {
                Some(Self::PositionDependentFriction(Effect::draw(at, share, random)))
            }
            EffectKind::FrictionTemperatureDrift => {
                Some(Self::FrictionTemperatureDrift(Effect::draw(at, share, random)))
            }
            EffectKind::Backlash => Some(Self::Backlash(Effect::draw(at, share, random))),
            EffectKind::JointElasticity => {
                Some(Self::JointElasticity(Effect::draw(at, share, random)))
            }
            EffectKind::RotorInertia => Some(Self::RotorInertia(Effect::draw(at, share, random))),
            EffectKind::DifferentialCoupling => {
                Some(Self::DifferentialCoupling(Effect::draw(at, share, random)))
            }
            EffectKind::Payload => Some(Self::Payload(Effect::draw(at, share, random))),
            EffectKind::InertialParameters => {
                Some(Self::InertialParameters(Effect::draw(at, share, random)))
            }
            EffectKind::GravityDirection => {
                Some(Self::GravityDirection(Effect::draw(at, share, random)))
            }
            EffectKind::CableSpring => Some(Self::CableSpring(Effect::draw(at, share, random))),
            EffectKind::TorqueRipple => Some(Self::TorqueRipple(Effect::draw(at, share, random))),
            EffectKind::TorqueConstant => {
                Some(Self::TorqueConstant(Effect::draw(at, share, random)))
            }
            EffectKind::TorqueOffset => Some(Self::TorqueOffset(Effect::draw(at, share, random))),
            EffectKind::ActuatorLag => Some(Self::ActuatorLag(Effect::draw(at, share, random))),
            EffectKind::ActuatorDelay => Some(Self::ActuatorDelay(Effect::draw(at, share, random))),
            EffectKind::TorqueSaturation => {
                Some(Self::TorqueSaturation(Effect::draw(at, share, random)))
            }
            EffectKind::EncoderOffset => Some(Self::EncoderOffset(Effect::draw(at, share, random))),
            EffectKind::TransmissionRatio => {
                Some(Self::TransmissionRatio(Effect::draw(at, share, random)))
            }
            EffectKind::TimeSkew => Some(Self::TimeSkew(Effect::draw(at, share, random))),
            EffectKind::ExternalDisturbance => {
                Some(Self::ExternalDisturbance(Effect::draw(at, share, random)))
            }
        }
    }
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

fn kind_of<E: Effect>(_: &E) -> EffectKind {
    E::KIND
}

/// The index of a joint that a scenario names.
fn joint_of(robot: &Robot, name: &str) -> Result<usize, Mistake> {
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
fn within(key: &'static str, value: f64, low: f64, high: f64) -> Result<(), Mistake> {
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
