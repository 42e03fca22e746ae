use std::cmp::Ordering;
use std::collections::BTreeMap;
use std::fmt;

use catalogue::EffectKind;
use experiment::{Estimated, Score};
use serde::{Serialize, Serializer};

use crate::statistics::share::Share;

/// Name of the first finding where there is none.
pub(super) const NOTHING: &str = "nothing";

/// Results of many trials.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Tally {
    /// One row for every kind that was injected alone, by code; then single effects of all kinds, trials with two
    /// effects, trials with an effect that is not looked for, and clean trials. Groups without trials are left out.
    pub rows: Vec<TallyRow>,
}

/// A group of trials.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TrialGroup {
    /// One effect of this kind was injected.
    Kind(EffectKind),
    /// One effect of any kind was injected.
    One,
    /// Two or more effects were injected.
    Two,
    /// One effect was injected that is not looked for.
    Unknown,
    /// Nothing was injected.
    Clean,
}

/// Results of a group of trials.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct TallyRow {
    /// The injected effects.
    #[serde(rename = "put_in")]
    pub injected: TrialGroup,
    /// Number of trials.
    pub trials: usize,
    /// Trials in which the injected effects were named first, at their places; in clean trials, nothing was named.
    pub exactly: Share,
    /// The same, of the trials whose logs show the effects (see [`Score::visible`]).
    pub visibly: Share,
    /// Trials in which the injected effects are the first findings or rivals of these.
    pub as_one_of: Share,
    /// Trials in which all injected effects are findings or rivals of findings, first or not; no trials where nothing
    /// was injected.
    pub found: Share,
    /// Trials whose verdict leaves structure open and that name nothing false.
    pub unknown: Share,
    /// Trials with a finding that is neither true nor a rival of a true one.
    pub stray: Share,
    /// First findings by code, or `nothing`, with their counts.
    pub named_first: BTreeMap<&'static str, usize>,
    /// The parameters by name; for effects of any kind, all of them together as `all`.
    pub sizes: Vec<SizeTally>,
}

/// Errors of the estimates of a parameter, where its effect was named at its place.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SizeTally {
    /// Name of the parameter.
    pub name: String,
    /// Number of trials with an estimate.
    pub estimates: usize,
    /// Number of trials in which the logs determine it; the fields below are of these.
    pub determined: usize,
    /// Median relative error.
    pub median_error: Option<f64>,
    /// Intervals that contain the injected value.
    pub covered: Share,
}

impl Tally {
    /// The tally of some scores, independent of their order.
    pub fn of(scores: &[Score]) -> Self {
        let groups = TrialGroup::by_group(scores);
        Self {
            rows: groups
                .into_iter()
                .map(|(group, members)| TallyRow::new(group, &members))
                .collect(),
        }
    }
}

impl TrialGroup {
    /// Scores by group, in the order of the rows of a tally.
    pub(super) fn by_group(scores: &[Score]) -> Vec<(Self, Vec<&Score>)> {
        let mut groups: Vec<(Self, Vec<&Score>)> = Vec::new();
        for score in scores {
            for group in Self::all_of(score) {
                match groups.iter_mut().find(|(other, _)| *other == group) {
                    Some((_, members)) => members.push(score),
                    None => groups.push((group, vec![score])),
                }
            }
        }
        groups.sort_by(|(a, _), (b, _)| a.order(*b));
        groups
    }

    fn all_of(score: &Score) -> Vec<Self> {
        match &score.injected[..] {
            _ if !score.looked_for => vec![Self::Unknown],
            [] => vec![Self::Clean],
            [one] => vec![Self::Kind(one.at.effect), Self::One],
            _ => vec![Self::Two],
        }
    }

    fn order(self, other: Self) -> Ordering {
        let key = |group| match group {
            Self::Kind(kind) => (0, kind.code()),
            Self::One => (1, ""),
            Self::Two => (2, ""),
            Self::Unknown => (3, ""),
            Self::Clean => (4, ""),
        };
        key(self).cmp(&key(other))
    }
}

impl fmt::Display for TrialGroup {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Kind(kind) => f.write_str(&kind.label()),
            Self::One => f.write_str("one effect"),
            Self::Two => f.write_str("two effects"),
            Self::Unknown => f.write_str("not looked for"),
            Self::Clean => f.write_str("clean"),
        }
    }
}

/// As it is written.
impl Serialize for TrialGroup {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

impl TallyRow {
    fn new(injected: TrialGroup, scores: &[&Score]) -> Self {
        let share = |is: &dyn Fn(&Score) -> bool| Share::of(scores, |score| is(score));
        let mut named_first = BTreeMap::new();
        for score in scores {
            let first = score.findings.first().map_or(NOTHING, |first| first.at.effect.code());
            *named_first.entry(first).or_default() += 1;
        }
        let visible: Vec<&&Score> = scores.iter().filter(|s| s.visible()).collect();
        let hiding: Vec<&&Score> = scores.iter().filter(|s| !s.injected.is_empty()).collect();
        Self {
            injected,
            trials: scores.len(),
            exactly: share(&|score| score.exactly),
            visibly: Share::of(&visible, |score| score.exactly),
            as_one_of: share(&|score| score.as_one_of),
            found: Share::of(&hiding, |score| score.is_found()),
            unknown: share(&Score::unknown),
            stray: share(&|score| !score.stray.is_empty()),
            named_first,
            sizes: sizes(injected, scores),
        }
    }
}

fn sizes(group: TrialGroup, scores: &[&Score]) -> Vec<SizeTally> {
    let mut named: BTreeMap<&str, Vec<&Estimated>> = BTreeMap::new();
    for size in scores.iter().flat_map(|score| &score.injected).flat_map(|injected| &injected.sizes)
    {
        let name = if matches!(group, TrialGroup::Kind(_)) { size.name.as_str() } else { "all" };
        named.entry(name).or_default().extend(&size.estimate);
    }
    named.into_iter().map(|(name, estimates)| SizeTally::new(name, &estimates)).collect()
}

impl SizeTally {
    pub(crate) fn new(name: &str, estimates: &[&Estimated]) -> Self {
        let determined: Vec<_> = estimates.iter().filter(|e| e.determined).collect();
        Self {
            name: name.to_owned(),
            estimates: estimates.len(),
            determined: determined.len(),
            median_error: median(determined.iter().filter_map(|e| e.relative_error).collect()),
            covered: Share::of(&determined, |e| e.covers),
        }
    }
}

/// The middle number, or the mean of the two in the middle.
pub(crate) fn median(mut numbers: Vec<f64>) -> Option<f64> {
    numbers.sort_by(f64::total_cmp);
    let (last, half) = (numbers.len().checked_sub(1)?, numbers.len() / 2);
    Some(0.5 * (numbers[last - half] + numbers[half]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_median_is_in_the_middle() {
        assert_eq!(median(vec![]), None);
        assert_eq!(median(vec![3.0]), Some(3.0));
        assert_eq!(median(vec![9.0, 1.0, 2.0]), Some(2.0));
        assert_eq!(median(vec![9.0, 1.0, 2.0, 4.0]), Some(3.0));
    }
}
