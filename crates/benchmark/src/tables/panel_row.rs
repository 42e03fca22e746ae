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
    /// The property that the trials have in common.
    pub side: PanelSide,
    /// Number of trials.
    pub trials: usize,
    /// Precision and recall of the diagnosis.
    pub named: Naming,
    /// The same, weighted by torque: a finding by its share of the gap's power, a cause by its torque.
    pub named_by_torque: Naming,
    /// Precision and recall of the two questions.
    pub two_questions: Naming,
    /// Precision and recall of plain least squares.
    pub least_squares: Naming,
    /// Trials that hide something visible but are called consistent, or explained with some of it unnamed.
    pub false_assurance: Share,
    /// Trials without anything visible in which something is named or left open.
    pub false_alarm: Share,
    /// Number of trials whose logs the diagnosis rejects.
    pub refused: usize,
    /// Trials in which the findings make the torque prediction worse.
    pub worse: Share,
    /// Median torque errors over that of the robot as described.
    pub ratios: Ratios,
    /// Median time of a diagnosis (s).
    pub median_s: Option<f64>,
    /// 90th percentile of the time of a diagnosis (s).
    pub nine_of_ten_s: Option<f64>,
    /// Median time of making the logs of a trial, where they were made (s).
    pub logs_s: Option<f64>,
    /// Peak memory of a trial (MB).
    pub peak_memory_mb: Option<f64>,
}

/// Precision and recall of the names.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Naming {
    /// Names that are true, of all names.
    pub precision: Rate,
    /// Visible causes that are named, of all visible causes.
    pub recall: Rate,
}

/// Median torque errors on a held-out log, over those of the robot as described.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Ratios {
    /// Of the robot with the findings.
    pub extended: Option<f64>,
    /// Of plain least squares.
    pub least_squares: Option<f64>,
    /// Of the fit of the two questions.
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

/// The smallest of the numbers that at least nine of ten do not exceed.
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
