use catalogue::EffectKind;
use diagnosis::Estimate;
use population::TrueCause;
use simulator::Truth;

use crate::panel::place::place;

/// Levels of dry friction against positive and negative motion (N·m or N).
///
/// Dry friction of several causes at one joint adds up, and every finding of dry friction there states the sum. The
/// logs do not show which cause a level belongs to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct DryFriction {
    forward: f64,
    backward: f64,
}

impl DryFriction {
    /// The friction of all other causes at the joint of `cause`.
    pub fn beside(cause: &TrueCause, all: &[TrueCause]) -> Self {
        let is_beside = |other: &&TrueCause| {
            place(other) != place(cause)
                && cause.truth.joint.is_some()
                && other.truth.joint == cause.truth.joint
        };
        let none = Self { forward: 0.0, backward: 0.0 };
        all.iter().filter(is_beside).fold(none, |sum, other| {
            let Self { forward, backward } = Self::of(&other.truth);
            Self { forward: sum.forward + forward, backward: sum.backward + backward }
        })
    }

    /// The friction of one cause.
    fn of(truth: &Truth) -> Self {
        let value = |name: &str| truth.parameters.get(name).copied().unwrap_or(0.0);
        let [forward, backward] = match truth.effect {
            EffectKind::CoulombFriction
            | EffectKind::PreslidingFriction
            | EffectKind::PositionDependentFriction => [value("level"); 2],
            EffectKind::StribeckFriction => [value("coulomb"); 2],
            EffectKind::AsymmetricFriction => [value("forward"), value("backward")],
            _ => [0.0; 2],
        };
        Self { forward, backward }
    }

    fn mean(self) -> f64 {
        0.5 * (self.forward + self.backward)
    }

    /// The parameters that a correct finding of `truth` states, with this friction at the joint and the nominal level
    /// of the estimates:
    ///
    /// ```text
    /// level = own + beside,   share = share_own own / (own + beside + nominal)
    /// ```
    pub fn with(self, truth: &Truth, estimates: &[Estimate]) -> Truth {
        let own = Self::of(truth).mean();
        let nominal = estimates.iter().find(|e| e.name == "level").map_or(0.0, |e| e.nominal);
        let mut with = truth.clone();
        for (name, value) in &mut with.parameters {
            match (truth.effect, name.as_str()) {
                (EffectKind::AsymmetricFriction, "forward") => *value += self.forward,
                (EffectKind::AsymmetricFriction, "backward") => *value += self.backward,
                (EffectKind::PositionDependentFriction, "share") if own > 0.0 => {
                    *value *= own / (own + self.mean() + nominal);
                }
                (
                    EffectKind::CoulombFriction
                    | EffectKind::PreslidingFriction
                    | EffectKind::PositionDependentFriction,
                    "level",
                )
                | (EffectKind::StribeckFriction, "coulomb" | "breakaway") => *value += self.mean(),
                _ => {}
            }
        }
        with
    }
}

#[cfg(test)]
mod tests {
    use population::{CauseRole, Strength};

    use super::*;

    fn cause(effect: EffectKind, joint: &str, parameters: &[(&str, f64)]) -> TrueCause {
        let truth = Truth::at_joint(effect, joint, parameters);
        let strength = Strength { sigmas: 10.0, share: 0.5, torque: 0.1 };
        TrueCause { role: CauseRole::Background, truth, strength }
    }

    #[test]
    fn levels_of_one_joint_add_up_and_those_of_others_do_not() {
        let causes = [
            cause(EffectKind::CoulombFriction, "elbow", &[("level", 1.0)]),
            cause(EffectKind::AsymmetricFriction, "elbow", &[("forward", 0.5), ("backward", 0.3)]),
            cause(EffectKind::StribeckFriction, "wrist", &[("coulomb", 4.0), ("breakaway", 5.0)]),
            cause(EffectKind::ViscousFriction, "elbow", &[("viscous", 7.0)]),
        ];
        let stated =
            |k: usize| DryFriction::beside(&causes[k], &causes).with(&causes[k].truth, &[]);
        assert!((stated(0).parameters["level"] - 1.4).abs() < 1e-12);
        let levels = stated(1).parameters;
        assert!(
            (levels["forward"] - 1.5).abs() < 1e-12 && (levels["backward"] - 1.3).abs() < 1e-12
        );
        assert_eq!(stated(2), causes[2].truth);
        assert_eq!(stated(3), causes[3].truth);
    }

    #[test]
    fn a_share_is_of_the_whole_level() {
        let wave = [("level", 1.0), ("share", 0.4), ("phase", 0.1)];
        let causes = [
            cause(EffectKind::PositionDependentFriction, "elbow", &wave),
            cause(EffectKind::CoulombFriction, "elbow", &[("level", 2.0)]),
        ];
        let ci95 = [4.0, 5.0];
        let level = Estimate {
            name: "level",
            value: 4.5,
            ci95,
            noise95: ci95,
            nominal: 1.0,
            unit: "",
            determined: true,
        };
        let stated = DryFriction::beside(&causes[0], &causes).with(&causes[0].truth, &[level]);
        assert!((stated.parameters["share"] - 0.1).abs() < 1e-12);
        assert!((stated.parameters["level"] - 3.0).abs() < 1e-12);
        assert!((stated.parameters["phase"] - 0.1).abs() < 1e-12);
    }
}
