use catalogue::EffectKind;

use crate::any_effect::AnyEffect;
use crate::causes::asymmetric_friction::AsymmetricFriction;
use crate::causes::backlash::Backlash;
use crate::causes::cable_spring::CableSpring;
use crate::causes::coulomb_friction::CoulombFriction;
use crate::causes::counterbalance::Counterbalance;
use crate::causes::differential_coupling::DifferentialCoupling;
use crate::causes::encoder_offset::EncoderOffset;
use crate::causes::friction_temperature_drift::FrictionTemperatureDrift;
use crate::causes::goal_delay::GoalDelay;
use crate::causes::gravity_direction::GravityDirection;
use crate::causes::inertial_parameters::InertialParameters;
use crate::causes::joint_elasticity::JointElasticity;
use crate::causes::late_torque::LateTorque;
use crate::causes::load_dependent_friction::LoadDependentFriction;
use crate::causes::payload::Payload;
use crate::causes::position_dependent_friction::PositionDependentFriction;
use crate::causes::presliding_friction::PreslidingFriction;
use crate::causes::rotor_inertia::RotorInertia;
use crate::causes::stribeck_friction::StribeckFriction;
use crate::causes::time_skew::TimeSkew;
use crate::causes::torque_constant::TorqueConstant;
use crate::causes::torque_offset::TorqueOffset;
use crate::causes::transmission_ratio::TransmissionRatio;
use crate::causes::unmodelled::{
    EXTERNAL_DISTURBANCE, TORQUE_RIPPLE, TORQUE_SATURATION, Unmodelled,
};
use crate::causes::viscous_friction::ViscousFriction;

/// The effects that have a model, in the order in which hypotheses are laid out.
pub const MODELLED: [EffectKind; 25] = [
    EffectKind::ViscousFriction,
    EffectKind::CoulombFriction,
    EffectKind::AsymmetricFriction,
    EffectKind::StribeckFriction,
    EffectKind::PreslidingFriction,
    EffectKind::PositionDependentFriction,
    EffectKind::FrictionTemperatureDrift,
    EffectKind::TorqueOffset,
    EffectKind::RotorInertia,
    // Of two effects with the same columns the first counts: a payload is more likely than an error in the
    // description of the link.
    EffectKind::Payload,
    EffectKind::InertialParameters,
    EffectKind::CableSpring,
    EffectKind::Counterbalance,
    EffectKind::GravityDirection,
    EffectKind::TorqueConstant,
    EffectKind::LoadDependentFriction,
    EffectKind::EncoderOffset,
    EffectKind::TransmissionRatio,
    EffectKind::Backlash,
    EffectKind::JointElasticity,
    EffectKind::DifferentialCoupling,
    EffectKind::TimeSkew,
    EffectKind::ActuatorDelay,
    EffectKind::ActuatorLag,
    EffectKind::GoalDelay,
];

/// The model side of `kind`.
///
/// # Errors
///
/// The reason why columns `f(q, qd, qdd)` with constant weights cannot model the effect.
pub fn model(kind: EffectKind) -> Result<&'static dyn AnyEffect, &'static str> {
    find(kind).map_err(|effect| effect.reason)
}

/// How [`Compensation`](crate::Compensation) compensates an effect of the robot's description.
///
/// # Errors
///
/// The reason why an effect cannot be compensated.
pub fn remedy(kind: EffectKind) -> Result<&'static str, &'static str> {
    find(kind).map_or_else(|effect| effect.remedy, |effect| effect.remedy())
}

/// The file of `causes` that holds `kind`.
fn find(kind: EffectKind) -> Result<&'static dyn AnyEffect, Unmodelled> {
    Ok(match kind {
        EffectKind::ViscousFriction => &ViscousFriction,
        EffectKind::CoulombFriction => &CoulombFriction,
        EffectKind::AsymmetricFriction => &AsymmetricFriction,
        EffectKind::StribeckFriction => &StribeckFriction,
        EffectKind::PreslidingFriction => &PreslidingFriction,
        EffectKind::PositionDependentFriction => &PositionDependentFriction,
        EffectKind::FrictionTemperatureDrift => &FrictionTemperatureDrift,
        EffectKind::TorqueOffset => &TorqueOffset,
        EffectKind::RotorInertia => &RotorInertia,
        EffectKind::InertialParameters => &InertialParameters,
        EffectKind::Payload => &Payload,
        EffectKind::CableSpring => &CableSpring,
        EffectKind::Counterbalance => &Counterbalance,
        EffectKind::GravityDirection => &GravityDirection,
        EffectKind::TorqueConstant => &TorqueConstant,
        EffectKind::LoadDependentFriction => &LoadDependentFriction,
        EffectKind::EncoderOffset => &EncoderOffset,
        EffectKind::TransmissionRatio => &TransmissionRatio,
        EffectKind::Backlash => &Backlash,
        EffectKind::JointElasticity => &JointElasticity,
        EffectKind::TimeSkew => &TimeSkew,
        EffectKind::GoalDelay => &GoalDelay,
        EffectKind::ActuatorDelay => &LateTorque::Delay,
        EffectKind::ActuatorLag => &LateTorque::Lag,
        EffectKind::TorqueRipple => return Err(TORQUE_RIPPLE),
        EffectKind::DifferentialCoupling => &DifferentialCoupling,
        EffectKind::TorqueSaturation => return Err(TORQUE_SATURATION),
        EffectKind::ExternalDisturbance => return Err(EXTERNAL_DISTURBANCE),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_list_of_modelled_effects_holds_every_model_once() {
        for kind in EffectKind::ALL {
            let listed = MODELLED.iter().filter(|&&k| k == kind).count();
            assert_eq!(listed, usize::from(model(kind).is_ok()), "{kind}");
        }
        for kind in MODELLED {
            assert_eq!(model(kind).map(|m| m.kind()), Ok(kind));
        }
    }
}
