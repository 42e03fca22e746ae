use catalogue::EffectKind;

use crate::Explain;

/// The effects that have a model, in the order in which hypotheses are laid out.
pub const MODELLED: [EffectKind; 10] = [
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
        EffectKind::StribeckFriction => {
            return Err("the speed at which it falls is not a factor of a signal of the log, \
                        and only factors are solved for");
        }
        EffectKind::PositionDependentFriction | EffectKind::TorqueRipple => {
            return Err("its period is not a factor of a signal of the log, \
                        and only factors are solved for");
        }
        EffectKind::PreslidingFriction | EffectKind::Backlash => {
            return Err("it remembers where the joint last turned back: \
                        its state must be followed along the log");
        }
        EffectKind::JointElasticity => {
            return Err("motor and link move apart: \
                        the motion of the one must be solved from that of the other");
        }
        EffectKind::LoadDependentFriction => {
            return Err("the load it grows with depends on every other finding: \
                        the two must be solved for together");
        }
        EffectKind::FrictionTemperatureDrift => {
            return Err("it depends on the time since the drive was cold, which runs do not share");
        }
        EffectKind::DifferentialCoupling => {
            return Err("the ratio of the pair is not a factor of a signal of the log, \
                        and only factors are solved for");
        }
        EffectKind::ActuatorLag | EffectKind::ActuatorDelay | EffectKind::TimeSkew => {
            return Err("it moves torque in time: it needs the torque of neighbouring samples");
        }
        EffectKind::TorqueSaturation => {
            return Err("it needs the command and the torque side by side, a log has one effort");
        }
        EffectKind::EncoderOffset | EffectKind::TransmissionRatio => {
            return Err("the arm is in another pose than the log says: \
                        every torque must be evaluated there anew");
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
