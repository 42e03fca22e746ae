use catalogue::EffectKind;
use rand_chacha::ChaCha8Rng;
use robot::Robot;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::effects::actuator_delay::ActuatorDelay;
use crate::effects::actuator_lag::ActuatorLag;
use crate::effects::asymmetric_friction::AsymmetricFriction;
use crate::effects::backlash::Backlash;
use crate::effects::cable_spring::CableSpring;
use crate::effects::coulomb_friction::CoulombFriction;
use crate::effects::counterbalance::Counterbalance;
use crate::effects::differential_coupling::DifferentialCoupling;
use crate::effects::effect::Effect;
use crate::effects::encoder_offset::EncoderOffset;
use crate::effects::external_disturbance::ExternalDisturbance;
use crate::effects::friction_temperature_drift::FrictionTemperatureDrift;
use crate::effects::gravity_direction::GravityDirection;
use crate::effects::inertial_parameters::InertialParameters;
use crate::effects::joint_elasticity::JointElasticity;
use crate::effects::load_dependent_friction::LoadDependentFriction;
use crate::effects::mistake::Mistake;
use crate::effects::payload::Payload;
use crate::effects::position_dependent_friction::PositionDependentFriction;
use crate::effects::presliding_friction::PreslidingFriction;
use crate::effects::rotor_inertia::RotorInertia;
use crate::effects::stribeck_friction::StribeckFriction;
use crate::effects::surroundings::Surroundings;
use crate::effects::time_skew::TimeSkew;
use crate::effects::torque_constant::TorqueConstant;
use crate::effects::torque_offset::TorqueOffset;
use crate::effects::torque_ripple::TorqueRipple;
use crate::effects::torque_saturation::TorqueSaturation;
use crate::effects::transmission_ratio::TransmissionRatio;
use crate::effects::truth::Truth;
use crate::effects::viscous_friction::ViscousFriction;
use crate::mechanics::inject::Inject;

/// Makes [`EffectSpec`] of the list of effects, and calls the [`Effect`] that it is.
macro_rules! effects {
    ($($(#[$meaning:meta])* $name:ident,)*) => {
        /// Any effect, as `[[effect]]` of a scenario states it: one key, the effect's name.
        #[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
        #[serde(rename_all = "snake_case")]
        pub enum EffectSpec {
            $($(#[$meaning])* $name($name),)*
        }

        impl EffectSpec {
            /// Its name.
            pub fn kind(&self) -> EffectKind {
                match self {
                    $(Self::$name(_) => <$name as Effect>::KIND,)*
                }
            }

            /// Where it acts, and its parameters under the catalogue's names.
            pub fn truth(&self) -> Truth {
                match self {
                    $(Self::$name(effect) => effect.truth(),)*
                }
            }

            /// The effect ready to act on a robot; see [`Effect::inject`].
            ///
            /// # Errors
            ///
            /// [`Mistake`], the first found: a joint that the robot does not have, or a value
            /// that no arm has.
            pub fn inject(&self, robot: &Robot) -> Result<Box<dyn Inject>, Mistake> {
                match self {
                    $(Self::$name(effect) => effect.inject(robot),)*
                }
            }

            /// An effect of a kind, drawn; see [`Effect::draw`].
            pub fn draw(
                kind: EffectKind,
                at: &Surroundings<'_>,
                share: f64,
                random: &mut ChaCha8Rng,
            ) -> Self {
                match kind {
                    $(EffectKind::$name => Self::$name(Effect::draw(at, share, random)),)*
                }
            }
        }
    };
}

effects! {
    /// Torque against the motion in proportion to velocity.
    ViscousFriction,
    /// Torque of constant size against the motion.
    CoulombFriction,
    /// Dry friction with one level for each direction.
    AsymmetricFriction,
    /// Dry friction that is larger at rest.
    StribeckFriction,
    /// Dry friction that gives like a spring before it slides.
    PreslidingFriction,
    /// Dry friction that grows with the torque carried.
    LoadDependentFriction,
    /// Dry friction that varies with position.
    PositionDependentFriction,
    /// Friction that falls while the drive warms up.
    FrictionTemperatureDrift,
    /// Free play between motor and link.
    Backlash,
    /// A spring with damping between motor and link.
    JointElasticity,
    /// Inertia of the motor beyond the description.
    RotorInertia,
    /// Dry friction at the two motors of a differential.
    DifferentialCoupling,
    /// A body fixed to a link.
    Payload,
    /// What a link truly weighs.
    InertialParameters,
    /// A base that does not stand as described.
    GravityDirection,
    /// A hose or cable that pulls at a joint.
    CableSpring,
    /// Torque of the motor that its angle decides.
    TorqueRipple,
    /// Effort in a wrong unit of torque.
    TorqueConstant,
    /// A constant in the reported effort.
    TorqueOffset,
    /// Torque that follows its command as through a filter.
    ActuatorLag,
    /// Torque that comes a fixed time after its command.
    ActuatorDelay,
    /// A drive that gives no more than its limit.
    TorqueSaturation,
    /// An encoder whose zero is not the joint's.
    EncoderOffset,
    /// A gear ratio that is not the one the drive was told.
    TransmissionRatio,
    /// Effort and position of different instants in one row.
    TimeSkew,
    /// A torque or force from the world around.
    ExternalDisturbance,
    /// A spring or weight that carries part of the weight of what a joint lifts.
    Counterbalance,
}
