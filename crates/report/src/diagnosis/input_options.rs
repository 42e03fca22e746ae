use std::path::PathBuf;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How the robot and the logs of a diagnosis were read, in the words of the program's options: what a later command
/// needs to read them in the same way. Which files they were is in the provenance.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default)]
pub struct InputOptions {
    /// The joints that move; empty for all that move in the files (`--joints`).
    pub joints: Vec<String>,
    /// Where locked joints stand (rad or m, `--locked`).
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub locked: Vec<(String, f64)>,
    /// Folders of packages, by name (`--package`).
    pub packages: Vec<(String, PathBuf)>,
    /// Meshes may lie anywhere (`--allow-outside`).
    pub allow_outside: bool,
    /// The map of the columns, where it is one of those with a name (`--map`).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub map: Option<String>,
    /// The column of the effort (`--effort`).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub effort: Option<String>,
    /// The topic of a bag (`--topic`).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub topic: Option<String>,
    /// First and last number of ranges of episodes; empty for all (`--episodes`).
    pub episodes: Vec<(u64, u64)>,
    /// Damaged logs are read up to their damage (`--until-damage`).
    pub until_damage: bool,
    /// Where reading begins, after the first row (s, `--from-s`).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub from_s: Option<f64>,
    /// Where reading ends, after the first row (s, `--to-s`).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub to_s: Option<f64>,
    /// Long logs are read whole (`--all-samples`).
    pub all_samples: bool,
}
