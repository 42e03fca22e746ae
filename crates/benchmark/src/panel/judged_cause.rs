use catalogue::EffectKind;
use diagnosis::{EffectAt, Finding, RuledOut};
use experiment::{Size, stored};
use population::{CauseRole, Strength, TrueCause};
use serde::{Deserialize, Serialize};

use crate::panel::dry_friction::DryFriction;
use crate::panel::judged_finding::BaselineClaim;
use crate::panel::place::place;

/// A cause in the data, and the methods that name it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct JudgedCause {
    /// The effect and its place.
    #[serde(flatten, deserialize_with = "stored::place")]
    pub at: EffectAt,
    /// Why it is in the data.
    pub role: CauseRole,
    /// Its strength, as an oracle measures it.
    pub strength: Strength,
    /// Index of the finding that names it.
    pub finding: Option<usize>,
    /// Index of the first finding that is the cause, has it as a rival, or bears it: Coulomb friction is borne by
    /// every form of dry friction of its joint.
    pub one_of: Option<usize>,
    /// Why the diagnosis rules it out, if it does.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub ruled_out: Option<String>,
    /// Whether plain least squares names it.
    pub least_squares: bool,
    /// Its parameters; levels of dry friction are those of all causes at the joint.
    pub sizes: Vec<Size>,
}

impl JudgedCause {
    /// One of `all` causes, compared with the findings and the claims of the baselines.
    pub(super) fn new(
        (cause, all): (&TrueCause, &[TrueCause]),
        findings: &[&Finding],
        ruled_out: &[RuledOut],
        claims: &[BaselineClaim],
    ) -> Self {
        let at = place(cause);
        let finding = findings.iter().position(|f| f.at == at);
        let says =
            |f: &&Finding| f.at == at || f.not_separable_from.contains(&at) || bears(&f.at, &at);
        let one_of = findings.iter().position(says);
        let estimates = finding.map_or(&[][..], |f| &findings[f].parameters);
        let ruled_out = ruled_out.iter().find(|other| other.at == at);
        Self {
            role: cause.role,
            strength: finite(cause.strength),
            finding,
            one_of,
            ruled_out: ruled_out.map(|other| other.because.clone()),
            least_squares: claims.iter().any(|claim| claim.at == at),
            sizes: Size::all(
                &DryFriction::beside(cause, all).with(&cause.truth, estimates),
                estimates,
            ),
            at,
        }
    }

    /// Whether an oracle detects it and it is above the floor.
    pub fn visible(&self) -> bool {
        self.strength.visible()
    }

    /// Whether a finding is it, has it as a rival or bears it.
    pub fn is_named(&self) -> bool {
        self.one_of.is_some()
    }
}

/// Whether a finding is a form of dry friction that bears Coulomb friction of the same joint: each opposes the motion
/// at any speed, so that a constant level is part of its own.
fn bears(finding: &EffectAt, cause: &EffectAt) -> bool {
    use EffectKind as E;
    let is_form = matches!(
        finding.effect,
        E::AsymmetricFriction
            | E::StribeckFriction
            | E::PreslidingFriction
            | E::LoadDependentFriction
            | E::PositionDependentFriction
    );
    is_form && cause.effect == E::CoulombFriction && finding.joint == cause.joint
}

/// A strength that JSON can hold. An infinite strength, of a cause without noise, becomes the largest number; NaN
/// becomes zero.
pub(super) fn finite(strength: Strength) -> Strength {
    let to_finite = |number: f64| if number.is_nan() { 0.0 } else { number.clamp(0.0, f64::MAX) };
    Strength {
        sigmas: to_finite(strength.sigmas),
        share: to_finite(strength.share),
        torque: to_finite(strength.torque),
    }
}
