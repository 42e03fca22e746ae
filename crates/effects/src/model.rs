use catalogue::EffectKind;

use crate::effect::Explain;

/// The effects that have a model, in the order in which hypotheses are laid out.
pub const MODELLED: [EffectKind; 24] = [
    EffectKind::ViscousFriction,
    EffectKind::CoulombFriction,
    EffectKind::AsymmetricFriction,
    EffectKind::StribeckFriction,
    EffectKind::PreslidingFriction,
    EffectKind::PositionDependentFriction,
    EffectKind::FrictionTemperatureDrift,
    EffectKind::TorqueOffset,
    EffectKind::RotorInertia,
    // Of the same columns the first counts: a body that is one is sooner carried than forgotten in
    // the description of the link.
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
];

/// The model side of `kind`; where there is none, what it would need.
///
/// # Errors
///
/// What a model of columns `f(q, qd, qdd)` and constant weights cannot hold.
pub fn model(kind: EffectKind) -> Result<&'static dyn Explain, &'static str> {
    Ok(match kind {
        EffectKind::ViscousFriction => &crate::causes::viscous_friction::ViscousFriction,
        EffectKind::CoulombFriction => &crate::causes::coulomb_friction::CoulombFriction,
        EffectKind::AsymmetricFriction => &crate::causes::asymmetric_friction::AsymmetricFriction,
        EffectKind::StribeckFriction => &crate::causes::stribeck_friction::StribeckFriction,
        EffectKind::PreslidingFriction => &crate::causes::presliding_friction::PreslidingFriction,
        EffectKind::PositionDependentFriction => {
            &crate::causes::position_dependent_friction::PositionDependentFriction
        }
        EffectKind::FrictionTemperatureDrift => {
            &crate::causes::friction_temperature_drift::FrictionTemperatureDrift
        }
        EffectKind::TorqueOffset => &crate::causes::torque_offset::TorqueOffset,
        EffectKind::RotorInertia => &crate::causes::rotor_inertia::RotorInertia,
        EffectKind::InertialParameters => &crate::causes::inertial_parameters::InertialParameters,
        EffectKind::Payload => &crate::causes::payload::Payload,
        EffectKind::CableSpring => &crate::causes::cable_spring::CableSpring,
        EffectKind::Counterbalance => &crate::causes::counterbalance::Counterbalance,
        EffectKind::GravityDirection => &crate::causes::gravity_direction::GravityDirection,
        EffectKind::TorqueConstant => &crate::causes::torque_constant::TorqueConstant,
        EffectKind::LoadDependentFriction => {
            &crate::causes::load_dependent_friction::LoadDependentFriction
        }
        EffectKind::EncoderOffset => &crate::causes::encoder_offset::EncoderOffset,
        EffectKind::TransmissionRatio => &crate::causes::transmission_ratio::TransmissionRatio,
        EffectKind::Backlash => &crate::causes::backlash::Backlash,
        EffectKind::JointElasticity => &crate::causes::joint_elasticity::JointElasticity,
        EffectKind::TimeSkew => &crate::causes::time_skew::TimeSkew,
        EffectKind::ActuatorDelay => &crate::causes::late_torque::LateTorque::Delay,
        EffectKind::ActuatorLag => &crate::causes::late_torque::LateTorque::Lag,
        EffectKind::TorqueRipple => {
            return Err("its period is finer than any trial value: it is a line of a spectrum");
        }
        EffectKind::DifferentialCoupling => {
            &crate::causes::differential_coupling::DifferentialCoupling
        }
        EffectKind::TorqueSaturation => {
            return Err("it is in what the log says of the effort, not in what the motion needs");
        }
        EffectKind::ExternalDisturbance => {
            return Err("it keeps to the clock, not to the motion: it is a line of a spectrum");
        }
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
