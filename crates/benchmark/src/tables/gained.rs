use experiment::{Gains, PredictionGain, Score};
use serde::Serialize;

use crate::statistics::share::Share;
use crate::statistics::text_table::TextTable;
use crate::tables::tally::{TrialGroup, median};

/// Share of the gap above which naming an effect should reduce an error by the factor [`ENOUGH`].
const LARGE: f64 = 0.6;

/// Factor by which an error should fall.
const ENOUGH: f64 = 2.0;

/// The gain of naming an effect, on held-out runs.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Gained {
    /// The injected effects.
    #[serde(rename = "put_in")]
    pub injected: TrialGroup,
    /// Number of trials with such runs.
    pub trials: usize,
    /// Of the torque error.
    pub torque: Reduction,
    /// Of the drift of the simulation after [`Gains::WINDOW_S`].
    pub drift: Reduction,
    /// Of the tracking error.
    pub tracking: Reduction,
}

/// Factor by which an error falls.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Reduction {
    /// In the median trial.
    pub median: Option<f64>,
    /// In the worst trial.
    pub least: Option<f64>,
    /// Trials in which the error at least halves, among those in which the injected effects were named and explain
    /// over 60 % of the nominal residual's power.
    pub halved: Share,
}

impl Gained {
    /// One for every group of trials in which gains were measured.
    pub fn all(scores: &[Score]) -> Vec<Self> {
        let groups = TrialGroup::by_group(scores).into_iter();
        groups.filter_map(|(injected, members)| Self::of(injected, &members)).collect()
    }

    fn of(injected: TrialGroup, scores: &[&Score]) -> Option<Self> {
        let measured: Vec<(&Score, Gains)> =
            scores.iter().filter_map(|score| Some((*score, score.gains?))).collect();
        let reduction = |of: fn(&Gains) -> Option<PredictionGain>| Reduction::of(&measured, of);
        (!measured.is_empty()).then(|| Self {
            injected,
            trials: measured.len(),
            torque: reduction(|gains| gains.torque),
            drift: reduction(|gains| gains.drift),
            tracking: reduction(|gains| gains.tracking),
        })
    }

    /// The gains as a table, one row each.
    pub fn table(all: &[Self]) -> TextTable {
        let header = ["put in", "trials", "torque", "drift", "tracking"];
        let halved = ["torque", "drift", "tracking"].map(|name| format!("{name} halved"));
        let row = |gained: &Self| {
            let errors = [&gained.torque, &gained.drift, &gained.tracking];
            let mut cells = vec![gained.injected.to_string(), gained.trials.to_string()];
            cells.extend(errors.map(Reduction::words));
            cells.extend(errors.map(|e| format!("{} of {}", e.halved.count, e.halved.of)));
            cells
        };
        let title = "how many times less the error is on a run that took no part: in the middle \
                     trial (in the worst); where it is half or less, of those named that make up \
                     over 60 % of the gap";
        TextTable {
            title: title.to_owned(),
            header: header.map(str::to_owned).into_iter().chain(halved).collect(),
            rows: all.iter().map(row).collect(),
        }
    }
}

impl Reduction {
    fn of(measured: &[(&Score, Gains)], of: fn(&Gains) -> Option<PredictionGain>) -> Self {
        let times = |(_, gains): &(&Score, Gains)| of(gains).map(|gain| gain.times());
        let all: Vec<f64> = measured.iter().filter_map(times).collect();
        let large: Vec<f64> = measured
            .iter()
            .filter(|(score, _)| score.explained_share() > LARGE)
            .filter_map(times)
            .collect();
        Self {
            least: all.iter().copied().min_by(f64::total_cmp),
            median: median(all),
            halved: Share::of(&large, |times| *times >= ENOUGH),
        }
    }

    /// Such as `12x (0.98x)`.
    fn words(&self) -> String {
        let times = |times: f64| match times {
            t if t < 9.95 => format!("{t:.1}x"),
            t => format!("{t:.0}x"),
        };
        match (self.median, self.least) {
            (Some(median), Some(least)) => format!("{} ({})", times(median), times(least)),
            _ => "-".to_owned(),
        }
    }
}

#[cfg(test)]
mod tests {
    use catalogue::EffectKind::CoulombFriction;
    use diagnosis::{EffectAt, Verdict};

    use super::*;
    use experiment::Injected;
    use experiment::Named;

    fn score(share_explained: f64, before: f64) -> Score {
        let at = EffectAt { effect: CoulombFriction, joint: Some("a".to_owned()), link: None };
        let gain = Some(PredictionGain { before, after: 0.5 });
        let not_separable_from = Vec::new();
        Score {
            seed: 1,
            injected: vec![Injected {
                at: at.clone(),
                finding: Some(0),
                one_of: Some(0),
                sizes: Vec::new(),
                of_smallest: None,
            }],
            looked_for: true,
            verdict: Verdict::Explained,
            findings: vec![Named { at, share_explained, not_separable_from }],
            exactly: true,
            as_one_of: true,
            stray: Vec::new(),
            gains: Some(Gains { torque: gain, drift: gain, tracking: None }),
        }
    }

    #[test]
    fn a_gain_is_counted_where_the_finding_is_most_of_the_gap() {
        let unmeasured = Score { gains: None, ..score(0.9, 9.0) };
        let scores = [score(0.9, 5.0), score(0.9, 0.6), score(0.3, 0.4), unmeasured];
        let gained = &Gained::all(&scores)[0];
        assert_eq!((gained.injected, gained.trials), (TrialGroup::Kind(CoulombFriction), 3));
        assert_eq!((gained.torque.median, gained.torque.least), (Some(1.2), Some(0.8)));
        assert_eq!((gained.torque.halved.count, gained.torque.halved.of), (1, 2));
        assert_eq!((gained.tracking.median, gained.tracking.halved.of), (None, 0));
        let [_, _, torque, _, tracking, halved, ..] =
            &Gained::table(&Gained::all(&scores)).rows[0][..]
        else {
            panic!("too short a row");
        };
        assert_eq!([torque, tracking, halved], ["1.2x (0.8x)", "-", "1 of 2"]);
    }

    #[test]
    fn nothing_is_said_where_nothing_was_measured() {
        assert_eq!(Gained::all(&[Score { gains: None, ..score(0.9, 9.0) }]), []);
    }
}
