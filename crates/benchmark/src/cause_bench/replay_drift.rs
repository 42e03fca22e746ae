use std::collections::BTreeMap;
use std::path::Path;

use serde::Deserialize;

use crate::error::BenchmarkError;

/// Largest file (bytes).
const MOST_BYTES: u64 = 16 << 20;

/// Times after which a replayed arm is compared (ms).
pub const REPLAY_TIMES_MS: [u32; 3] = [50, 200, 1000];

/// How far the models of an entrant drift from the arms, as the replay in MuJoCo measures it.
#[derive(Debug, Clone, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ReplayDrift {
    /// By trial, for each of [`REPLAY_TIMES_MS`]: root mean square over joints and starts of the distance of the positions
    /// (rad or m).
    pub trials: BTreeMap<String, [f64; 3]>,
}

impl ReplayDrift {
    /// Reads a file of `tests/benches/replay_answers.py`.
    ///
    /// # Errors
    ///
    /// [`BenchmarkError::UnusableBenchFile`].
    pub fn open(path: &Path) -> Result<Self, BenchmarkError> {
        let unusable = |found: String| BenchmarkError::UnusableBenchFile {
            path: path.to_owned(),
            found,
            expected: "drifts as replay_answers.py writes them",
        };
        let text = files::text(path, MOST_BYTES).map_err(|e| unusable(e.to_string()))?;
        serde_json::from_str(&text).map_err(|e| unusable(e.to_string()))
    }
}
