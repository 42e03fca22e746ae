use std::cmp::Ordering;
use std::collections::BTreeMap;
use std::fmt;

use catalogue::EffectKind;
use experiment::{Estimated, Score};
use serde::{Serialize, Serializer};

use crate::statistics::share::Share;

/// What the first finding is called where there is none.
pub(super) const NOTHING: &str = "nothing";

/// What many trials come to.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Tally {
    /// One for every kind that was put in alone, by code; then all of these together, trials
    /// with two effects, those with one that is not looked for, and clean ones. Those without a
    /// trial are left out.
    pub rows: Vec<TallyRow>,
}

/// Trials that belong together.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TrialGroup {
    /// One effect of this kind was put in.
    Kind(EffectKind),
    /// One effect of any kind.
    One,
    /// More than one.
    Two,
    /// One that is not looked for.
    Unknown,
    /// None.
    Clean,
}

/// A group of trials.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct TallyRow {
    /// What was put in.
    #[serde(rename = "put_in")]
    pub injected: TrialGroup,
    /// How many trials there are.
    pub trials: usize,
    /// Trials in which it was named first, effect and place; nothing, in clean ones.
    pub exactly: Share,
    /// The same of those trials whose logs show it, see [`Score::visible`].
    pub visibly: Share,
    /// Trials in which it was named first or a rival of what was.
    pub as_one_of: Share,
    /// Trials in which all of it was named or a rival of what was, first or not; of none where
    /// there was nothing to find.
    pub found: Share,
    /// Trials whose verdict leaves structure open and names nothing wrong.
    pub unknown: Share,
    /// Trials with a finding that is neither true nor a rival of a true one.
    pub stray: Share,
    /// What was named first, by code or `nothing`, and how often.
    pub named_first: BTreeMap<&'static str, usize>,
    /// Its parameters by name; of effects of any kind, all of them as `all`.
    pub sizes: Vec<SizeTally>,
}

/// How good the estimates of a parameter are, where its effect was named at its place.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SizeTally {
    /// Name of the parameter.
    pub name: String,
    /// Trials with an estimate.
    pub estimates: usize,
    /// Those in which the logs narrow it down, on which all that follows rests.
    pub determined: usize,
    /// Median relative error.
    pub median_error: Option<f64>,
    /// Intervals that hold the truth.
    pub covered: Share,
}

impl Tally {
    /// The tally of some scores, whatever their order.
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
