use serde::Serialize;

use crate::panel::judgement::Judgement;
use crate::panel::panel_side::PanelSide;
use crate::panel::prediction::{Prediction, RelativeError};
use crate::statistics::median::median;
use crate::statistics::rate::{Fraction, Rate};
use crate::statistics::share::Share;

/// Trials with one property in common.
///
/// All but their number, refusals and costs is of trials whose logs are not spoilt.
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
    /// Precision and recall of plain least squares.
    pub least_squares: Naming,
    /// Trials that hide something visible but are called consistent, or explained with some of it unnamed.
    pub false_assurance: Share,
    /// Trials without anything visible in which something is named or left open.
    pub false_alarm: Share,
    /// Number of trials whose logs the diagnosis rejects.
    pub refused: usize,
    /// Number of trials whose logs are spoilt so that an oracle sees it.
    pub spoilt: usize,
    /// Trials in which the findings make the torque prediction worse than that of the robot as described.
    pub worse: Share,
    /// Joints at which they do.
    pub worse_joints: Rate,
    /// Trials in which the extended robot predicts worse than plain least squares.
    pub worse_than_by_hand: Share,
    /// Joints at which it does.
    pub joints_worse_than_by_hand: Rate,
    /// Findings of which the logs determine a size.
    pub sizes_told: Rate,
    /// Median width of the 95 per cent intervals of those, over the value.
    pub sharpness: Option<f64>,
    /// Intervals of determined sizes that hold the truth, where a finding names a visible cause.
    pub covered: Rate,
    /// Findings about links whose mass or centre of mass is off by more than its interval, weighted by kg.
    pub bodies_off: Rate,
    /// Visible causes that are ruled out with a reason.
    pub ruled_out: Rate,
    /// Reasons that contradict the answer.
    pub contradicting: Rate,
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
}

impl PanelRow {
    pub(super) fn new(side: PanelSide, all: &[&Judgement]) -> Self {
        let share = |is: fn(&Judgement) -> Option<bool>| {
            let answers: Vec<bool> = all.iter().filter_map(|one| is(one)).collect();
            Share::of(&answers, |answer| *answer)
        };
        let rate = |of: fn(&Judgement) -> Fraction| Rate::over(all.iter().map(|one| of(one)));
        let joints = |of: fn(&Prediction) -> Fraction| {
            Rate::over(all.iter().filter_map(|one| one.fair_prediction().map(of)))
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
                recall: rate(Judgement::recall),
            },
            named_by_torque: Naming {
                precision: Rate::over(all.iter().filter_map(|one| one.precision_by_torque())),
                recall: rate(Judgement::recall_by_torque),
            },
            least_squares: Naming {
                precision: Rate::over(
                    all.iter().filter_map(|one| one.precision_of_least_squares()),
                ),
                recall: rate(Judgement::recall_of_least_squares),
            },
            false_assurance: share(Judgement::false_assurance),
            false_alarm: share(Judgement::false_alarm),
            refused: all.iter().filter(|one| one.refused.is_some()).count(),
            spoilt: all.iter().filter(|one| one.is_spoilt()).count(),
            worse: share(|one| one.fair_prediction()?.worse()),
            worse_joints: joints(Prediction::worse_joints),
            worse_than_by_hand: share(|one| one.fair_prediction()?.worse_than_by_hand()),
            joints_worse_than_by_hand: joints(Prediction::joints_worse_than_by_hand),
            sizes_told: rate(Judgement::sizes_told),
            sharpness: median(all.iter().flat_map(|one| one.sharpness()).collect()),
            covered: rate(Judgement::coverage),
            bodies_off: rate(Judgement::bodies_off),
            ruled_out: rate(Judgement::ruled_out),
            contradicting: rate(Judgement::contradicting),
            ratios: Ratios::new(all),
            nine_of_ten_s: percentile_90(&times),
            median_s: median(times),
            logs_s: median(made),
            peak_memory_mb: memory.max_by(f64::total_cmp),
        }
    }
}

impl Ratios {
    fn new(all: &[&Judgement]) -> Self {
        let fair = || all.iter().filter_map(|one| one.fair_prediction());
        let of = |error: fn(&Prediction) -> Option<&RelativeError>| {
            median(fair().filter_map(|prediction| prediction.ratio(error(prediction))).collect())
        };
        Self {
            extended: of(|prediction| prediction.extended.as_ref()),
            least_squares: of(|prediction| prediction.least_squares.as_ref()),
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
