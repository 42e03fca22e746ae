use std::fmt;
use std::str::FromStr;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Makes [`EffectKind`] of the list of effects.
macro_rules! kinds {
    ($($(#[$meaning:meta])* $variant:ident $name:ident $code:literal;)*) => {
        /// A named cause of a gap between a robot and its simulation.
        ///
        /// Each has a [`name`](Self::name), which files use, and a [`code`](Self::code), which stands
        /// beside the name wherever it is printed.
        #[derive(
            Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize, JsonSchema,
        )]
        #[serde(rename_all = "snake_case")]
        pub enum EffectKind {
            $($(#[$meaning])* $variant,)*
        }

        impl EffectKind {
            /// Every effect, in the order in which random draws count them.
            pub const ALL: [Self; [$($code),*].len()] = [$(Self::$variant),*];

            /// The code that stands beside the name: two letters of the family and two digits. It
            /// never changes.
            pub const fn code(self) -> &'static str {
                match self {
                    $(Self::$variant => $code,)*
                }
            }

            /// The name used in files and on the command line.
            pub const fn name(self) -> &'static str {
                match self {
                    $(Self::$variant => stringify!($name),)*
                }
            }
        }
    };
}

crate::for_each_effect!(kinds);

impl EffectKind {
    /// Whether its torque grows as its first parameter falls, as with the stiffness of a spring.
    pub const fn grows_as_its_size_falls(self) -> bool {
        matches!(self, Self::JointElasticity)
    }

    /// In words, what two encoders of a joint cannot decide about it.
    pub const fn left_open_by_two_encoders(self) -> Option<&'static str> {
        match self {
            Self::EncoderOffset => Some(
                "it is what the two encoders differ by: which of them is off, a pose measured from outside tells",
            ),
            _ => None,
        }
    }
}

impl fmt::Display for EffectKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// No effect has this name or code.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct UnknownEffect(
    /// What was asked for.
    pub String,
);

impl fmt::Display for UnknownEffect {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let names = EffectKind::ALL.map(|k| format!("{} {k}", k.code()));
        write!(f, "effect {}: not in the catalogue, expected one of {}", self.0, names.join(", "))
    }
}

impl std::error::Error for UnknownEffect {}

impl FromStr for EffectKind {
    type Err = UnknownEffect;

    /// The effect with this name or code, in capitals or small letters.
    fn from_str(text: &str) -> Result<Self, UnknownEffect> {
        Self::ALL
            .into_iter()
            .find(|k| [k.name(), k.code()].iter().any(|known| known.eq_ignore_ascii_case(text)))
            .ok_or_else(|| UnknownEffect(text.to_owned()))
    }
}

#[cfg(test)]
mod tests {
    use serde::de::IntoDeserializer;
    use serde::de::value::{Error, StrDeserializer};

    use super::*;

    #[test]
    fn a_payload_among_rivals_says_what_tells_them_apart() {
        let own = EffectKind::CoulombFriction.entry().told_apart_by;
        let rivals = [EffectKind::ViscousFriction, EffectKind::StribeckFriction];
        assert_eq!(EffectKind::CoulombFriction.distinguishing_motion(rivals), Some(own));
        assert_eq!(EffectKind::CoulombFriction.distinguishing_motion([]), None);
        let payload = EffectKind::Payload.entry().told_apart_by;
        let rivals = [EffectKind::GravityDirection, EffectKind::Payload];
        assert_eq!(EffectKind::InertialParameters.distinguishing_motion(rivals), Some(payload));
    }

    /// Never to be changed, only added to: see [`EffectKind::code`].
    const CODES: [(&str, &str); 27] = [
        ("FR01", "viscous_friction"),
        ("FR02", "coulomb_friction"),
        ("FR03", "asymmetric_friction"),
        ("FR04", "stribeck_friction"),
        ("FR05", "presliding_friction"),
        ("FR06", "load_dependent_friction"),
        ("FR07", "position_dependent_friction"),
        ("FR08", "friction_temperature_drift"),
        ("TR01", "backlash"),
        ("TR02", "joint_elasticity"),
        ("TR03", "differential_coupling"),
        ("TR04", "transmission_ratio"),
        ("IN01", "payload"),
        ("IN02", "inertial_parameters"),
        ("IN03", "rotor_inertia"),
        ("DR01", "torque_ripple"),
        ("DR02", "torque_constant"),
        ("DR03", "torque_offset"),
        ("DR04", "actuator_lag"),
        ("DR05", "actuator_delay"),
        ("DR06", "torque_saturation"),
        ("SE01", "encoder_offset"),
        ("SE02", "time_skew"),
        ("EN01", "gravity_direction"),
        ("EN02", "cable_spring"),
        ("EN03", "external_disturbance"),
        ("EN04", "counterbalance"),
    ];

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

    #[test]
    fn a_code_is_for_good_and_finds_its_effect_as_the_name_does_in_any_case() {
        for (code, name) in CODES {
            let kind = read(name).unwrap();
            assert_eq!((kind.code(), kind.name()), (code, name));
            for text in [code, name, &code.to_lowercase(), &name.to_uppercase()] {
                assert_eq!(text.parse(), Ok(kind), "{text}");
            }
        }
        assert_eq!("FR00".parse::<EffectKind>(), Err(UnknownEffect("FR00".to_owned())));
    }

    #[test]
    fn a_code_is_the_letters_of_its_family_and_two_digits_and_no_other_effects() {
        for kind in EffectKind::ALL {
            let (code, family) = (kind.code(), kind.family());
            let digits = code.strip_prefix(family.letters()).unwrap_or_default();
            assert!(digits.len() == 2 && digits.bytes().all(|b| b.is_ascii_digit()), "{code}");
            assert_eq!(EffectKind::ALL.iter().filter(|k| k.code() == code).count(), 1, "{code}");
        }
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
