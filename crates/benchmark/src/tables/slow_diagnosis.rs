use serde::Serialize;

use crate::panel::judgement::Judgement;

/// A diagnosis that took long, and the size of its task.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SlowDiagnosis {
    /// Seed of the trial.
    pub seed: u64,
    /// Its arm, motion and effort.
    pub corner: String,
    /// Number of joints of the arm.
    pub joints: usize,
    /// Number of logs.
    pub logs: usize,
    /// Number of samples of a joint over all logs.
    pub samples: f64,
    /// Number of findings.
    pub findings: usize,
    /// Time of the diagnosis (s).
    pub time_s: f64,
}

impl SlowDiagnosis {
    /// Time above which every diagnosis is listed (s).
    pub const LONG_S: f64 = 60.0;

    /// Number of diagnoses that are listed whatever their time.
    const MOST: usize = 10;

    /// The ten that took longest, and every one over [`LONG_S`](Self::LONG_S); the longest first.
    pub(super) fn all(judgements: &[Judgement]) -> Vec<Self> {
        let mut sorted: Vec<&Judgement> = judgements.iter().collect();
        let time = |one: &Judgement| one.costs.diagnosis_s;
        sorted.sort_by(|a, b| time(b).total_cmp(&time(a)).then(a.seed.cmp(&b.seed)));
        let listed =
            |(place, one): &(usize, &Judgement)| *place < Self::MOST || time(one) > Self::LONG_S;
        sorted.into_iter().enumerate().filter(listed).map(|(_, one)| Self::new(one)).collect()
    }

    fn new(one: &Judgement) -> Self {
        let corner = &one.corner;
        let words = format!("{}, {}, {}", corner.arm, corner.motion, corner.effort);
        Self {
            seed: one.seed,
            corner: words.replace('_', " "),
            joints: corner.joints,
            logs: corner.logs,
            samples: one.samples(),
            findings: one.findings.len(),
            time_s: one.costs.diagnosis_s,
        }
    }
}
