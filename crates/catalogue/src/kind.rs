use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};

/// A named cause of a gap between a robot and its simulation.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum EffectKind {
    /// Torque proportional to velocity.
    ViscousFriction,
    /// Torque of constant size against the motion.
    CoulombFriction,
    /// Coulomb friction that differs between the two directions.
    AsymmetricFriction,
    /// A constant added to the reported effort.
    TorqueOffset,
    /// Inertia of rotor and gear seen at the joint.
    RotorInertia,
    /// Mass, centre of mass or inertia of one link.
    InertialParameters,
    /// A body carried by the last link.
    Payload,
    /// A hose or cable that pulls a joint towards a rest position.
    CableSpring,
    /// Gravity points elsewhere than the model says: a tilted base.
    GravityDirection,
    /// Reported effort scaled by a wrong factor.
    TorqueConstant,
}

impl EffectKind {
    /// Every effect, in the order in which they are listed to the user.
    pub const ALL: [Self; 10] = [
        Self::ViscousFriction,
        Self::CoulombFriction,
        Self::AsymmetricFriction,
        Self::TorqueOffset,
        Self::RotorInertia,
        Self::InertialParameters,
        Self::Payload,
        Self::CableSpring,
        Self::GravityDirection,
        Self::TorqueConstant,
    ];

    /// The name used in files and on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::ViscousFriction => "viscous_friction",
            Self::CoulombFriction => "coulomb_friction",
            Self::AsymmetricFriction => "asymmetric_friction",
            Self::TorqueOffset => "torque_offset",
            Self::RotorInertia => "rotor_inertia",
            Self::InertialParameters => "inertial_parameters",
            Self::Payload => "payload",
            Self::CableSpring => "cable_spring",
            Self::GravityDirection => "gravity_direction",
            Self::TorqueConstant => "torque_constant",
        }
    }

    /// The name in words, for sentences.
    pub fn words(self) -> &'static str {
        match self {
            Self::ViscousFriction => "viscous friction",
            Self::CoulombFriction => "Coulomb friction",
            Self::AsymmetricFriction => "asymmetric friction",
            Self::TorqueOffset => "torque offset",
            Self::RotorInertia => "rotor inertia",
            Self::InertialParameters => "inertial parameters",
            Self::Payload => "payload",
            Self::CableSpring => "cable spring",
            Self::GravityDirection => "gravity direction",
            Self::TorqueConstant => "torque constant",
        }
    }
}

impl fmt::Display for EffectKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// No effect has this name.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct UnknownEffect(
    /// The name that was asked for.
    pub String,
);

impl fmt::Display for UnknownEffect {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let names: Vec<_> = EffectKind::ALL.iter().map(|k| k.name()).collect();
        write!(f, "effect {}: not in the catalogue, expected one of {}", self.0, names.join(", "))
    }
}

impl std::error::Error for UnknownEffect {}

impl FromStr for EffectKind {
    type Err = UnknownEffect;

    fn from_str(name: &str) -> Result<Self, UnknownEffect> {
        Self::ALL
            .into_iter()
            .find(|k| k.name() == name)
            .ok_or_else(|| UnknownEffect(name.to_owned()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_name_is_read_back_and_a_wrong_one_is_refused() {
        for kind in EffectKind::ALL {
            assert_eq!(kind.name().parse(), Ok(kind));
        }
        assert_eq!("frictoin".parse::<EffectKind>(), Err(UnknownEffect("frictoin".to_owned())));
    }

    #[test]
    fn confusion_is_mutual() {
        for kind in EffectKind::ALL {
            for &other in kind.entry().confused_with {
                assert!(
                    other.entry().confused_with.contains(&kind),
                    "{other} does not name {kind}"
                );
            }
        }
    }
}
