use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};

/// A named cause of a gap between a robot and its simulation.
///
/// By family: friction, transmission, what the arm carries, drive, sensors, surroundings.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum EffectKind {
    /// Torque proportional to velocity.
    ViscousFriction,
    /// Torque of constant size against the motion.
    CoulombFriction,
    /// Coulomb friction that differs between the two directions.
    AsymmetricFriction,
    /// Dry friction that is larger at rest and falls as the joint begins to move.
    StribeckFriction,
    /// Dry friction that gives like a spring before it slides.
    PreslidingFriction,
    /// Dry friction that grows with the torque carried.
    LoadDependentFriction,
    /// Dry friction that varies with the position of the joint.
    PositionDependentFriction,
    /// Friction that falls while the drive warms up.
    FrictionTemperatureDrift,
    /// Play between motor and link.
    Backlash,
    /// A spring and damper between motor and link.
    JointElasticity,
    /// Inertia of rotor and gear seen at the joint.
    RotorInertia,
    /// Friction at the two motors of a differential that drives two joints.
    DifferentialCoupling,
    /// A body carried by the last link.
    Payload,
    /// Mass, centre of mass or inertia of one link.
    InertialParameters,
    /// Gravity points elsewhere than the model says: a tilted base.
    GravityDirection,
    /// A hose or cable that pulls a joint towards a rest position.
    CableSpring,
    /// Torque that varies with the angle of the motor.
    TorqueRipple,
    /// Reported effort scaled by a wrong factor.
    TorqueConstant,
    /// A constant added to the reported effort.
    TorqueOffset,
    /// Torque that follows its command as through a first-order filter.
    ActuatorLag,
    /// Torque that comes a fixed time after its command.
    ActuatorDelay,
    /// Torque that ends at a limit whatever the command.
    TorqueSaturation,
    /// A constant added to the reported position.
    EncoderOffset,
    /// Reported position scaled by a wrong gear ratio.
    TransmissionRatio,
    /// Effort and position logged at different instants under one time.
    TimeSkew,
    /// A force from outside: periodic at a joint, or a push at the last link.
    ExternalDisturbance,
}

impl EffectKind {
    /// Every effect, in the order in which they are listed to the user.
    pub const ALL: [Self; 26] = [
        Self::ViscousFriction,
        Self::CoulombFriction,
        Self::AsymmetricFriction,
        Self::StribeckFriction,
        Self::PreslidingFriction,
        Self::LoadDependentFriction,
        Self::PositionDependentFriction,
        Self::FrictionTemperatureDrift,
        Self::Backlash,
        Self::JointElasticity,
        Self::RotorInertia,
        Self::DifferentialCoupling,
        Self::Payload,
        Self::InertialParameters,
        Self::GravityDirection,
        Self::CableSpring,
        Self::TorqueRipple,
        Self::TorqueConstant,
        Self::TorqueOffset,
        Self::ActuatorLag,
        Self::ActuatorDelay,
        Self::TorqueSaturation,
        Self::EncoderOffset,
        Self::TransmissionRatio,
        Self::TimeSkew,
        Self::ExternalDisturbance,
    ];

    /// The name used in files and on the command line.
    pub const fn name(self) -> &'static str {
        self.entry().name
    }

    /// The name in words, for sentences.
    pub const fn words(self) -> &'static str {
        self.entry().words
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
    use serde::de::IntoDeserializer;
    use serde::de::value::{Error, StrDeserializer};

    use super::*;

    fn read(name: &str) -> Result<EffectKind, Error> {
        let deserializer: StrDeserializer<'_, Error> = name.into_deserializer();
        EffectKind::deserialize(deserializer)
    }

    #[test]
    fn every_name_is_read_back_and_a_wrong_one_is_refused() {
        for kind in EffectKind::ALL {
            assert_eq!(kind.name().parse(), Ok(kind));
            assert_eq!(kind.entry().kind, kind);
        }
        assert_eq!("frictoin".parse::<EffectKind>(), Err(UnknownEffect("frictoin".to_owned())));
    }

    /// serde's message lists every variant, in the order of the enum.
    #[test]
    fn the_list_holds_every_effect_under_the_name_that_files_use() {
        let names = EffectKind::ALL.map(|k| format!("`{}`", k.name())).join(", ");
        let refusal = read("frictoin").unwrap_err().to_string();
        assert_eq!(refusal, format!("unknown variant `frictoin`, expected one of {names}"));
    }

    #[test]
    fn a_name_in_words_is_the_name_with_spaces() {
        for kind in EffectKind::ALL {
            let plain = kind.words().to_lowercase().replace([' ', '-'], "_");
            assert_eq!(plain, kind.name());
        }
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

    /// One body may be taken for another; anything else is not confused with itself.
    #[test]
    fn every_effect_is_confused_with_others_and_with_each_once() {
        for kind in EffectKind::ALL {
            let rivals = kind.entry().confused_with;
            let count = |r: &EffectKind| rivals.iter().filter(|o| *o == r).count();
            assert!(!rivals.is_empty() && rivals.iter().all(|r| count(r) == 1), "{kind}");
            let body = kind == EffectKind::InertialParameters;
            assert_eq!(rivals.contains(&kind), body, "{kind}");
        }
    }

    #[test]
    fn every_parameter_has_a_name_of_its_own_and_a_range() {
        for kind in EffectKind::ALL {
            let parameters = kind.entry().parameters;
            assert!(!parameters.is_empty(), "{kind}");
            for p in parameters {
                let (low, high) = p.typical;
                assert!(low.is_finite() && low < high && high.is_finite(), "{kind} {}", p.name);
                let same = parameters.iter().filter(|o| o.name == p.name).count();
                assert_eq!(same, 1, "{kind} {}", p.name);
            }
        }
    }
}
