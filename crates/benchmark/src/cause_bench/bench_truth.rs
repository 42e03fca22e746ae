use std::collections::BTreeMap;
use std::path::Path;

use population::TruthSheet;
use serde::{Deserialize, Serialize};

use crate::error::BenchmarkError;
use crate::trials::hash::hexadecimal;

/// The schema that the truth of a set follows.
const TRUTH_SCHEMA: &str = "plumbline.cause_bench_truth/1";

/// Largest file of a truth: that of `core` has under 100 MB.
const MOST_BYTES: u64 = 1 << 30;

/// The truth of a set, in one file outside its folder.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct BenchTruth {
    /// Always `plumbline.cause_bench_truth/1`.
    schema: String,
    /// The trials by name.
    pub trials: BTreeMap<String, TrialTruth>,
}

/// What is true of a trial.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct TrialTruth {
    /// The causes in it, and what an oracle sees of them.
    pub sheet: TruthSheet,
    /// Efforts of the held-out log by joint (N m or N), one a row; empty for an arm that logs none.
    pub held_out_effort: BTreeMap<String, Vec<f32>>,
    /// Rows of that log in which a joint moves, as stretches from a row to before another: what dry friction holds, any
    /// effort up to its level may hold.
    pub moving: BTreeMap<String, Vec<[usize; 2]>>,
}

impl BenchTruth {
    /// The truth of these trials.
    pub fn new(trials: BTreeMap<String, TrialTruth>) -> Self {
        Self { schema: TRUTH_SCHEMA.to_owned(), trials }
    }

    /// The text of its file, and the SHA-256 of that text.
    ///
    /// # Errors
    ///
    /// [`BenchmarkError::UnusableBenchFile`] for a number that JSON cannot hold.
    pub fn seal(&self, path: &Path) -> Result<(String, String), BenchmarkError> {
        let text = serde_json::to_string(self).map_err(|error| unusable(path, &error))? + "\n";
        let hash = hexadecimal(&text);
        Ok((text, hash))
    }

    /// Opens the truth of the set whose manifest has this SHA-256.
    ///
    /// # Errors
    ///
    /// [`BenchmarkError::UnusableBenchFile`], also for the truth of another set.
    pub fn open(path: &Path, sha256: &str) -> Result<Self, BenchmarkError> {
        let text = files::text(path, MOST_BYTES).map_err(|error| unusable(path, &error))?;
        let found = hexadecimal(&text);
        if found != sha256 {
            return Err(BenchmarkError::UnusableBenchFile {
                path: path.to_owned(),
                found: format!("SHA-256 {found}"),
                expected: "the truth that the manifest is sealed with",
            });
        }
        serde_json::from_str(&text).map_err(|error| unusable(path, &error))
    }
}

fn unusable(path: &Path, found: &dyn std::fmt::Display) -> BenchmarkError {
    BenchmarkError::UnusableBenchFile {
        path: path.to_owned(),
        found: found.to_string(),
        expected: "the truth of a set, as plumbline-bench export writes it",
    }
}
