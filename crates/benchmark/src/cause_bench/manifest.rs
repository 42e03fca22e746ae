use std::path::Path;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::cause_bench::bench_set::BenchSet;
use crate::error::BenchmarkError;

/// The schema that `manifest.json` of a set follows.
pub const MANIFEST_SCHEMA: &str = "plumbline.cause_bench/1";

/// `manifest.json`: the trials of a set, and nothing of their truth.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(title = "Manifest of a set of CauseBench")]
pub struct BenchManifest {
    /// Always `plumbline.cause_bench/1`.
    pub schema: String,
    /// The set.
    pub set: BenchSet,
    /// SHA-256 of the file with the truth, in hexadecimal.
    pub truth_sha256: String,
    /// The trials.
    pub trials: Vec<BenchTrial>,
}

/// A trial: an arm as described, and logs of the arm as it is. Paths are relative to the folder of the set.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct BenchTrial {
    /// Its name, and that of its folder and of the answer to it.
    pub name: String,
    /// The described arm as URDF.
    pub urdf: String,
    /// The described arm as MJCF: drives have its `armature`, `damping` and `frictionloss`.
    pub mjcf: String,
    /// `robot.toml`, what a URDF cannot say: drives, sensors, controller.
    pub description: String,
    /// The joints, from the base.
    pub joints: Vec<String>,
    /// The links that the joints move, in the same order.
    pub links: Vec<String>,
    /// Where the effort of a joint comes from, as described: `measured` behind the drive, `current` or `commanded`
    /// before it, or `unknown`.
    pub effort_source: Vec<String>,
    /// The logs to learn from.
    pub logs: Vec<BenchLog>,
    /// Another motion, without its efforts and without noise: they are to be predicted.
    pub held_out: BenchLog,
}

/// A log as Parquet and as npz, with the same columns: `time` (s) and, a joint, `JOINT.CHANNEL` in rad or m, per s,
/// N m or N.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct BenchLog {
    /// The Parquet file.
    pub parquet: String,
    /// The npz file.
    pub npz: String,
    /// Number of rows.
    pub rows: usize,
    /// Rate of the rows by their times: one over the median step (Hz).
    pub rate_hz: Option<f64>,
    /// Channels of the joints: `position`, `effort` and others.
    pub channels: Vec<String>,
}

impl BenchManifest {
    /// Name of its file.
    pub const FILE: &str = "manifest.json";

    /// Reads the manifest of a folder.
    ///
    /// # Errors
    ///
    /// [`BenchmarkError::UnusableBenchFile`].
    pub fn open(folder: &Path) -> Result<Self, BenchmarkError> {
        let path = folder.join(Self::FILE);
        let unusable = |found: String| BenchmarkError::UnusableBenchFile {
            path: path.clone(),
            found,
            expected: "the manifest of a set, as plumbline-bench export writes it",
        };
        let text = files::text(&path, files::KEPT_BYTES).map_err(|e| unusable(e.to_string()))?;
        let manifest: Self = serde_json::from_str(&text).map_err(|e| unusable(e.to_string()))?;
        match manifest.schema.as_str() {
            MANIFEST_SCHEMA => Ok(manifest),
            other => Err(unusable(format!("schema {other:?}"))),
        }
    }

    /// The trials, counted from 0, to which a folder has no answer.
    pub fn remaining(&self, answers: &Path) -> Vec<usize> {
        let is_answered =
            |trial: &BenchTrial| answers.join(format!("{}.json", trial.name)).exists();
        (0..self.trials.len()).filter(|k| !is_answered(&self.trials[*k])).collect()
    }
}
