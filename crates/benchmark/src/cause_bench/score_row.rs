use serde::{Deserialize, Serialize};

use crate::cause_bench::judged_answers::JudgedAnswer;
use crate::statistics::middle::Middle;
use crate::statistics::rate::{Fraction, Rate};

/// The tasks of CauseBench over some trials, one number each with its 95 per cent interval.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ScoreRow {
    /// The trials: `all`, or what they have in common, such as `arm cobot`.
    pub trials: String,
    /// Number of trials.
    pub count: usize,
    /// Name: F1 of visible causes.
    pub name: Rate,
    /// Of the names, those that stand for a cause.
    pub true_names: Rate,
    /// Of the visible causes, those that are named.
    pub named: Rate,
    /// Size: stated sizes of named visible causes whose interval holds the truth.
    pub size: Rate,
    /// Width of the sharpest interval of a name over its value.
    pub sharpness: Middle,
    /// Predict: nMSE of the efforts of the held-out log.
    pub predict: Middle,
    /// Replay: drift after 50, 200 and 1000 ms (rad or m).
    pub replay: [Middle; 3],
    /// Abstain: of trials with a visible effect of no catalogue, with spoilt logs or with nothing visible, those in which
    /// the answer holds back as it should.
    pub abstain: Rate,
    /// Cost: processor time as stated (s).
    pub cost_s: Middle,
}

impl ScoreRow {
    /// The row of these answers.
    pub(super) fn new(trials: String, answers: &[&JudgedAnswer]) -> Self {
        let each =
            |of: &dyn Fn(&JudgedAnswer) -> Fraction| Rate::over(answers.iter().map(|a| of(a)));
        let part =
            |hits: usize, of: usize| Fraction { hits: hits as f64, of: of as f64, items: of };
        let middle = |of: &dyn Fn(&JudgedAnswer) -> Option<f64>| {
            Middle::of(answers.iter().filter_map(|answer| of(answer)).collect())
        };
        Self {
            trials,
            count: answers.len(),
            name: each(&|a| a.names.f1()),
            true_names: each(&|a| part(a.names.true_names, a.names.names)),
            named: each(&|a| part(a.names.named, a.names.visible)),
            size: each(&|a| a.judgement.coverage()),
            sharpness: Middle::of(answers.iter().flat_map(|a| a.judgement.sharpness()).collect()),
            predict: middle(&|a| a.nmse),
            replay: [0, 1, 2].map(|k| middle(&|a| a.drift.map(|drift| drift[k]))),
            abstain: each(&|a| a.holds_back().map_or(part(0, 0), |held| part(held.into(), 1))),
            cost_s: middle(&|a| a.seconds),
        }
    }
}
