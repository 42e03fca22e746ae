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
use crate::effects::encoder_offset::EncoderOffset;
use crate::effects::external_disturbance::ExternalDisturbance;
use crate::effects::friction_temperature_drift::FrictionTemperatureDrift;
use crate::effects::goal_delay::GoalDelay;
use crate::effects::gravity_direction::GravityDirection;
use crate::effects::inertial_parameters::InertialParameters;
use crate::effects::joint_elasticity::JointElasticity;
use crate::effects::load_dependent_friction::LoadDependentFriction;
use crate::effects::mistake::Mistake;
use crate::effects::payload::Payload;
use crate::effects::position_dependent_friction::PositionDependentFriction;
use crate::effects::presliding_friction::PreslidingFriction;
use crate::effects::rotor_inertia::RotorInertia;
use crate::effects::scenario_effect::ScenarioEffect;
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

/// Makes [`EffectSpec`] of the catalogue's list of effects, and calls the [`ScenarioEffect`] that it is.
macro_rules! effects {
    ($($(#[$meaning:meta])* $name:ident $file:ident $code:literal;)*) => {
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
                    $(Self::$name(_) => <$name as ScenarioEffect>::KIND,)*
                }
            }

            /// Where it acts, and its parameters under the catalogue's names.
            pub fn truth(&self) -> Truth {
                match self {
                    $(Self::$name(effect) => effect.truth(),)*
                }
            }

            /// The effect ready to act on a robot; see [`ScenarioEffect::inject`].
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

            /// An effect of a kind, drawn; see [`ScenarioEffect::draw`].
            pub fn draw(
                kind: EffectKind,
                at: &Surroundings<'_>,
                share: f64,
                random: &mut ChaCha8Rng,
            ) -> Self {
                match kind {
                    $(EffectKind::$name => Self::$name(ScenarioEffect::draw(at, share, random)),)*
                }
            }
        }
    };
}

catalogue::for_each_effect!(effects);
