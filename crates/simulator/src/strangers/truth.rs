use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::strangers::kind::StrangerKind;

/// One stranger in a simulation.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct StrangerTruth {
    /// The stranger.
    pub stranger: StrangerKind,
    /// The joint it acts at.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub joint: Option<String>,
    /// The link it acts at.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub link: Option<String>,
    /// Parameters (SI).
    pub parameters: BTreeMap<String, f64>,
}

impl StrangerTruth {
    /// The truth of a stranger at a joint.
    pub fn at_joint(stranger: StrangerKind, joint: &str, parameters: &[(&str, f64)]) -> Self {
        Self { joint: Some(joint.to_owned()), ..Self::everywhere(stranger, parameters) }
    }

    /// The truth of a stranger of the whole arm.
    pub fn everywhere(stranger: StrangerKind, parameters: &[(&str, f64)]) -> Self {
        let parameters = parameters.iter().map(|&(name, v)| (name.to_owned(), v)).collect();
        Self { stranger, joint: None, link: None, parameters }
    }
}
