use std::path::Path;

use crate::cause_bench::answer_fault::AnswerFault;
use crate::cause_bench::bench_truth::{BenchTruth, TrialTruth};
use crate::cause_bench::manifest::{BenchManifest, BenchTrial};
use crate::cause_bench::name_match::NameMatch;
use crate::cause_bench::prediction_error::{nmse, read_prediction};
use crate::cause_bench::replay_drift::ReplayDrift;
use crate::cause_bench::spoken::SpokenAnswer;
use crate::panel::answers::{Answers, Costs, HeldOut};
use crate::panel::judgement::Judgement;

/// A trial of CauseBench with what became of the answer to it.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct JudgedAnswer {
    /// The answer by the judge of all trials.
    pub judgement: Judgement,
    /// Its names beside the causes.
    pub names: NameMatch,
    /// Error of the predicted efforts; `None` for spoilt logs and for an arm that logs no effort.
    pub nmse: Option<f64>,
    /// Drift of its model (rad or m), where it hands one in.
    pub drift: Option<[f64; 3]>,
    /// Processor time that it states (s).
    pub seconds: Option<f64>,
}

/// Judges the answers in a folder, and says which count as nothing said.
///
/// # Errors
///
/// [`AnswerFault`] of an answer that the disk failed to read.
pub(super) fn judge(
    (manifest, truth): (&BenchManifest, &BenchTruth),
    answers: &Path,
    replay: &ReplayDrift,
) -> Result<(Vec<JudgedAnswer>, Vec<AnswerFault>), AnswerFault> {
    let (mut judged, mut faults) = (Vec::new(), Vec::new());
    for trial in &manifest.trials {
        let Some(truth) = truth.trials.get(&trial.name) else { continue };
        let answer = SpokenAnswer::read(answers, trial).unwrap_or_else(|fault| {
            faults.push(fault);
            SpokenAnswer::silent()
        });
        judged.push(JudgedAnswer::new((trial, truth), answer, replay, &mut faults));
    }
    match faults.iter().position(|fault| fault.is_unread) {
        Some(unread) => Err(faults.swap_remove(unread)),
        None => Ok((judged, faults)),
    }
}

impl JudgedAnswer {
    fn new(
        (trial, truth): (&BenchTrial, &TrialTruth),
        answer: SpokenAnswer,
        replay: &ReplayDrift,
        faults: &mut Vec<AnswerFault>,
    ) -> Self {
        let predicted = answer.prediction.map(|path| read_prediction(&path, truth)).transpose();
        let predicted = predicted.unwrap_or_else(|fault| {
            faults.push(fault);
            None
        });
        let answers = Answers {
            diagnosis: answer.diagnosis,
            held_out: HeldOut::default(),
            least_squares: Vec::new(),
            costs: Costs { diagnosis_s: answer.seconds.unwrap_or(0.0), ..Costs::default() },
        };
        let judgement = Judgement::new(&truth.sheet, &answers);
        Self {
            names: NameMatch::new(&judgement),
            nmse: nmse(truth, &predicted.unwrap_or_default()).filter(|_| !judgement.is_spoilt()),
            drift: replay.trials.get(&trial.name).copied(),
            seconds: answer.seconds,
            judgement,
        }
    }

    /// Whether it holds back where it should: with a visible effect of no catalogue or spoilt logs it leaves something open
    /// or refuses, where nothing is visible it raises no alarm. `None` where neither is asked.
    pub fn holds_back(&self) -> Option<bool> {
        let judgement = &self.judgement;
        if let Some(misled) = judgement.is_misled() {
            return Some(!misled);
        }
        match judgement.hides_strangers() {
            true => Some(judgement.abstains()),
            false => judgement.false_alarm().map(|alarm| !alarm),
        }
    }
}
