use std::collections::BTreeMap;
use std::path::Path;

use serde::{Deserialize, Serialize};

use crate::cause_bench::answer_fault::AnswerFault;
use crate::cause_bench::bench_set::BenchSet;
use crate::cause_bench::bench_truth::BenchTruth;
use crate::cause_bench::judged_answers::{JudgedAnswer, judge};
use crate::cause_bench::manifest::BenchManifest;
use crate::cause_bench::replay_drift::ReplayDrift;
use crate::cause_bench::score_row::ScoreRow;
use crate::error::BenchmarkError;
use crate::panel::panel_side::PanelSide;

/// The schema that scores follow.
pub const SCORES_SCHEMA: &str = "plumbline.cause_bench_scores/1";

/// Largest file of scores (bytes).
const MOST_BYTES: u64 = 16 << 20;

/// Properties by which trials have rows of their own; the first is of all.
const PROPERTIES: [&str; 4] = ["", "arm", "motion", "effort"];

/// The scores of one entrant's answers to a set.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct BenchScores {
    /// Always `plumbline.cause_bench_scores/1`.
    pub schema: String,
    /// The set.
    pub set: BenchSet,
    /// Name of the entrant: that of the folder with its answers.
    pub entrant: String,
    /// The program that answered, with its version, as whoever scores it says.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub program: Option<String>,
    /// What counts as nothing said, each in a sentence.
    pub faults: Vec<String>,
    /// The scores of all trials, then by arm, motion and other properties.
    pub rows: Vec<ScoreRow>,
}

impl BenchScores {
    /// Reads scores from a file of `plumbline-bench score --json`.
    ///
    /// # Errors
    ///
    /// [`BenchmarkError::UnusableBenchFile`].
    pub fn open(path: &Path) -> Result<Self, BenchmarkError> {
        let unusable = |found: String| BenchmarkError::UnusableBenchFile {
            path: path.to_owned(),
            found,
            expected: "scores, as plumbline-bench score --json prints them",
        };
        let text = files::text(path, MOST_BYTES).map_err(|e| unusable(e.to_string()))?;
        let scores: Self = serde_json::from_str(&text).map_err(|e| unusable(e.to_string()))?;
        match scores.schema.as_str() {
            SCORES_SCHEMA => Ok(scores),
            other => Err(unusable(format!("schema {other:?}"))),
        }
    }

    /// Scores the answers in a folder by the truth of the set.
    ///
    /// # Errors
    ///
    /// [`BenchmarkError::UnusableBenchFile`] for a set, a truth or drifts that cannot be used, and for an answer that the disk
    /// failed to read. An answer that cannot be used is a fault.
    pub fn new(
        folder: &Path,
        answers: &Path,
        truth: &Path,
        replay: Option<&Path>,
    ) -> Result<Self, BenchmarkError> {
        let manifest = BenchManifest::open(folder)?;
        if !answers.is_dir() {
            return Err(BenchmarkError::UnusableBenchFile {
                path: answers.to_owned(),
                found: "no folder".to_owned(),
                expected: "a folder with a JSON file a trial",
            });
        }
        let truth = BenchTruth::open(truth, &manifest.truth_sha256)?;
        let replay = replay.map(ReplayDrift::open).transpose()?.unwrap_or_default();
        let unread = |fault: AnswerFault| {
            let (path, found, expected) = (fault.path, fault.found, "a file that can be read");
            BenchmarkError::UnusableBenchFile { path, found, expected }
        };
        let (judged, faults) = judge((&manifest, &truth), answers, &replay).map_err(unread)?;
        let whole = answers.canonicalize().unwrap_or_else(|_| answers.to_owned());
        let entrant = whole.file_name().unwrap_or_default().to_string_lossy().into_owned();
        Ok(Self {
            schema: SCORES_SCHEMA.to_owned(),
            set: manifest.set,
            entrant,
            program: None,
            faults: faults.iter().map(ToString::to_string).collect(),
            rows: rows(&judged),
        })
    }
}

/// The row of all trials, then one for each kind of arm, motion and effort.
fn rows(judged: &[JudgedAnswer]) -> Vec<ScoreRow> {
    let mut sides: BTreeMap<PanelSide, Vec<&JudgedAnswer>> = BTreeMap::new();
    for answer in judged {
        let all = PanelSide::of(&answer.judgement).into_iter();
        for side in all.filter(|side| PROPERTIES.contains(&side.thing())) {
            sides.entry(side).or_default().push(answer);
        }
    }
    sides.into_iter().map(|(side, answers)| ScoreRow::new(side.to_string(), &answers)).collect()
}
