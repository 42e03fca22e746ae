use catalogue::EffectKind;

use crate::Explain;

/// The effects that have a model, in the order in which hypotheses are laid out.
pub const MODELLED: [EffectKind; 18] = [
    EffectKind::ViscousFriction,
    EffectKind::CoulombFriction,
    EffectKind::AsymmetricFriction,
    EffectKind::TorqueOffset,
    EffectKind::RotorInertia,
    EffectKind::InertialParameters,
    EffectKind::Payload,
    EffectKind::CableSpring,
    EffectKind::GravityDirection,
    EffectKind::TorqueConstant,
    EffectKind::LoadDependentFriction,
    EffectKind::EncoderOffset,
    EffectKind::TransmissionRatio,
    EffectKind::Backlash,
    EffectKind::JointElasticity,
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
        EffectKind::ViscousFriction => &crate::viscous_friction::ViscousFriction,
        EffectKind::CoulombFriction => &crate::coulomb_friction::CoulombFriction,
        EffectKind::AsymmetricFriction => &crate::asymmetric_friction::AsymmetricFriction,
        EffectKind::TorqueOffset => &crate::torque_offset::TorqueOffset,
        EffectKind::RotorInertia => &crate::rotor_inertia::RotorInertia,
        EffectKind::InertialParameters => &crate::inertial_parameters::InertialParameters,
        EffectKind::Payload => &crate::payload::Payload,
        EffectKind::CableSpring => &crate::cable_spring::CableSpring,
        EffectKind::GravityDirection => &crate::gravity_direction::GravityDirection,
        EffectKind::TorqueConstant => &crate::torque_constant::TorqueConstant,
        EffectKind::LoadDependentFriction => &crate::load_dependent_friction::LoadDependentFriction,
        EffectKind::EncoderOffset => &crate::encoder_offset::EncoderOffset,
        EffectKind::TransmissionRatio => &crate::transmission_ratio::TransmissionRatio,
        EffectKind::Backlash => &crate::backlash::Backlash,
        EffectKind::JointElasticity => &crate::joint_elasticity::JointElasticity,
        EffectKind::TimeSkew => &crate::time_skew::TimeSkew,
        EffectKind::ActuatorDelay => &crate::late_torque::LateTorque::Delay,
        EffectKind::ActuatorLag => &crate::late_torque::LateTorque::Lag,
        EffectKind::StribeckFriction => {
            return Err("the speed at which it falls is not a factor of a signal of the log, \
                        and only factors are solved for");
        }
        EffectKind::PositionDependentFriction | EffectKind::TorqueRipple => {
            return Err("its period is not a factor of a signal of the log, \
                        and only factors are solved for");
        }
        EffectKind::PreslidingFriction => {
            return Err("it remembers where the joint last turned back: \
                        its state must be followed along the log");
        }
        EffectKind::FrictionTemperatureDrift => {
            return Err("it depends on the time since the drive was cold, which runs do not share");
        }
        EffectKind::DifferentialCoupling => {
            return Err("the ratio of the pair is not a factor of a signal of the log, \
                        and only factors are solved for");
        }
        EffectKind::TorqueSaturation => {
            return Err("it needs the command and the torque side by side, a log has one effort");
        }
        EffectKind::ExternalDisturbance => {
            return Err("it keeps to the clock, and only what follows the motion is looked for");
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
