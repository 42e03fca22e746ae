use std::collections::BTreeMap;

use catalogue::EffectKind;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// One effect in a simulation, with which scoring compares a diagnosis.
///
/// `truth.json` also holds the code of the effect, for readers.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Truth {
    /// The effect.
    pub effect: EffectKind,
    /// The joint it acts at; the first of two for a coupling.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub joint: Option<String>,
    /// The link it acts at.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub link: Option<String>,
    /// Parameters under the catalogue's names, in its units (SI).
    pub parameters: BTreeMap<String, f64>,
}

impl Truth {
    /// The truth of an effect at a joint.
    pub fn at_joint(effect: EffectKind, joint: &str, parameters: &[(&str, f64)]) -> Self {
        Self { joint: Some(joint.to_owned()), ..Self::everywhere(effect, parameters) }
    }

    /// The truth of an effect at a link.
    pub fn at_link(effect: EffectKind, link: &str, parameters: &[(&str, f64)]) -> Self {
        Self { link: Some(link.to_owned()), ..Self::everywhere(effect, parameters) }
    }

    /// The truth of an effect of the whole arm.
    pub fn everywhere(effect: EffectKind, parameters: &[(&str, f64)]) -> Self {
        let parameters = parameters.iter().map(|&(name, v)| (name.to_owned(), v)).collect();
        Self { effect, joint: None, link: None, parameters }
    }
}
