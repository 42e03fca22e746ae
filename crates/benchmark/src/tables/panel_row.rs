use serde::Serialize;

use crate::panel::judged_cause::JudgedCause;
use crate::panel::judged_finding::BaselineClaim;
use crate::panel::judgement::Judgement;
use crate::panel::panel_side::PanelSide;
use crate::panel::prediction::RelativeError;
use crate::statistics::rate::Rate;
use crate::statistics::share::Share;
use crate::tables::tally::median;

/// Trials of one side of a population.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PanelRow {
    /// What they are alike in.
    pub side: PanelSide,
    /// How many they are.
    pub trials: usize,
    /// How well the diagnosis names.
    pub named: Naming,
    /// The same by torque: a finding weighs its share of the gap's power, a cause its torque.
    pub named_by_torque: Naming,
    /// How well the two questions name.
    pub two_questions: Naming,
    /// How well plain least squares names.
    pub least_squares: Naming,
    /// Trials that hide something visible and are called consistent, or explained with some of it unnamed.
    pub false_assurance: Share,
    /// Trials without anything visible in which something is named or left open.
    pub false_alarm: Share,
    /// Trials whose logs the diagnosis refuses.
    pub refused: usize,
    /// Trials in which the findings make the prediction of torque worse.
    pub worse: Share,
    /// Median error of torque over that of the robot as described.
    pub ratios: Ratios,
    /// Median time of a diagnosis (s).
    pub median_s: Option<f64>,
    /// Time that nine of ten diagnoses keep to (s).
    pub nine_of_ten_s: Option<f64>,
    /// Median time of making the logs of a trial, where they were made (s).
    pub logs_s: Option<f64>,
    /// Largest memory of a trial (MB).
    pub peak_memory_mb: Option<f64>,
}

/// How well causes are named.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Naming {
    /// Names that are true, of all that are named.
    pub precision: Rate,
    /// Visible causes that are named, of all of them.
    pub recall: Rate,
}

/// Median errors of torque on a log that took no part, over those of the robot as described.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Ratios {
    /// Of the robot with the findings.
    pub extended: Option<f64>,
    /// Of plain least squares.
    pub least_squares: Option<f64>,
    /// Of what the two questions fit.
    pub two_questions: Option<f64>,
}

impl PanelRow {
    pub(super) fn new(side: PanelSide, all: &[&Judgement]) -> Self {
        let share = |is: fn(&Judgement) -> Option<bool>| {
            let answers: Vec<bool> = all.iter().filter_map(|one| is(one)).collect();
            Share::of(&answers, |answer| *answer)
        };
        let costs = |of: fn(&Judgement) -> f64| all.iter().map(|one| of(one)).collect::<Vec<_>>();
        let times = costs(|one| one.costs.diagnosis_s);
        let made = costs(|one| one.costs.logs_s).into_iter().filter(|s| *s > 0.0).collect();
        let memory = all.iter().filter_map(|one| one.costs.peak_memory_mb);
        Self {
            side,
            trials: all.len(),
            named: Naming {
                precision: Rate::over(all.iter().filter_map(|one| one.precision())),
                recall: Rate::over(all.iter().map(|one| one.recall())),
            },
            named_by_torque: Naming {
                precision: Rate::over(all.iter().filter_map(|one| one.precision_by_torque())),
                recall: Rate::over(all.iter().map(|one| one.recall_by_torque())),
            },
            two_questions: Naming::of(all, |one| &one.two_questions, |c| c.two_questions),
            least_squares: Naming::of(all, |one| &one.least_squares, |c| c.least_squares),
            false_assurance: share(Judgement::false_assurance),
            false_alarm: share(Judgement::false_alarm),
            refused: all.iter().filter(|one| one.refused.is_some()).count(),
            worse: share(|one| one.prediction.worse()),
            ratios: Ratios::new(all),
            nine_of_ten_s: percentile_90(&times),
            median_s: median(times),
            logs_s: median(made),
            peak_memory_mb: memory.max_by(f64::total_cmp),
        }
    }
}

impl Naming {
    fn of(
        all: &[&Judgement],
        claims: fn(&Judgement) -> &Vec<BaselineClaim>,
        names: fn(&JudgedCause) -> bool,
    ) -> Self {
        Self {
            precision: Rate::over(all.iter().filter_map(|one| one.precision_of(claims(one)))),
            recall: Rate::over(all.iter().map(|one| one.recall_of(names))),
        }
    }
}

impl Ratios {
    fn new(all: &[&Judgement]) -> Self {
        let of = |error: fn(&Judgement) -> Option<&RelativeError>| {
            median(all.iter().filter_map(|one| one.prediction.ratio(error(one))).collect())
        };
        Self {
            extended: of(|one| one.prediction.extended.as_ref()),
            least_squares: of(|one| one.prediction.least_squares.as_ref()),
            two_questions: of(|one| one.prediction.two_questions.as_ref()),
        }
    }
}

/// The least number that nine of ten do not exceed.
fn percentile_90(numbers: &[f64]) -> Option<f64> {
    let mut sorted = numbers.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted.get((9 * sorted.len()).div_ceil(10).checked_sub(1)?).copied()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn percentile_90_keep_to_it() {
        assert_eq!(percentile_90(&[]), None);
        assert_eq!(percentile_90(&[3.0]), Some(3.0));
        let ten: Vec<f64> = (1..=10).rev().map(f64::from).collect();
        assert_eq!(percentile_90(&ten), Some(9.0));
        assert_eq!(percentile_90(&[1.0, 2.0, 3.0]), Some(3.0));
    }
}
