use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Shares of trials whose robot and description differ as those of robots in use do, each 0 to 1. Zero leaves all
/// other draws of a trial as they are.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct RobotShares {
    /// Nominal models that are off by more than a few per cent, without any rotor: a mass by a factor of 1.5 to 4, a
    /// centre of mass by centimetres or its sign, placeholders for inertias, inertias in g mm2 or g cm2, a damping of
    /// 1 to 10, a tool that the arm lacks or that the model lacks.
    #[serde(skip_serializing_if = "is_zero")]
    pub wrong_urdfs: f64,
    /// Coulomb friction of a tenth to a third of the RMS effort at the joints that carry most, where the effort has
    /// friction in it.
    #[serde(skip_serializing_if = "is_zero")]
    pub strong_friction: f64,
    /// One delay at all drives, of the trials whose effort is the command.
    #[serde(skip_serializing_if = "is_zero")]
    pub delayed_drives: f64,
    /// Two joints exchanged, in the nominal model or in the columns of the logs, of the arms that have two.
    #[serde(skip_serializing_if = "is_zero")]
    pub exchanged_joints: f64,
    /// An axis that the nominal model has turned round.
    #[serde(skip_serializing_if = "is_zero")]
    pub turned_axes: f64,
    /// Nominal models that stand upright, of the arms on a base tilted by 5 to 90 degrees.
    #[serde(skip_serializing_if = "is_zero")]
    pub unknown_mounts: f64,
    /// Tools that the nominal model has and the arm lacks.
    #[serde(skip_serializing_if = "is_zero")]
    pub tools_taken_off: f64,
    /// A payload in the second half of the logs alone, of the trials with two logs and more.
    #[serde(skip_serializing_if = "is_zero")]
    pub changed_payloads: f64,
}

impl RobotShares {
    /// Whether nothing of the kind is drawn.
    pub(crate) fn is_none(&self) -> bool {
        *self == Self::default()
    }

    /// Every share by the name of its key.
    pub(crate) fn by_key(&self) -> [(&'static str, f64); 8] {
        [
            ("wrong_urdfs", self.wrong_urdfs),
            ("strong_friction", self.strong_friction),
            ("delayed_drives", self.delayed_drives),
            ("exchanged_joints", self.exchanged_joints),
            ("turned_axes", self.turned_axes),
            ("unknown_mounts", self.unknown_mounts),
            ("tools_taken_off", self.tools_taken_off),
            ("changed_payloads", self.changed_payloads),
        ]
    }

    /// What a trial may have whose model is right: friction alone.
    pub(crate) fn without_errors(&self) -> Self {
        Self { strong_friction: self.strong_friction, ..Self::default() }
    }
}

/// Whether a share is left out of a file.
fn is_zero(share: &f64) -> bool {
    *share <= 0.0
}
