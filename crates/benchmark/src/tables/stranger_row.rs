use std::collections::BTreeMap;

use diagnosis::Verdict;
use serde::Serialize;

use crate::panel::judgement::Judgement;
use crate::statistics::share::Share;

/// Trials in which one effect of no catalogue is in the data.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct StrangerRow {
    /// Its name; `all` for every one of them.
    pub name: String,
    /// Trials that have it.
    pub trials: usize,
    /// Those in which it leaves structure open, or refuses the logs, and names nothing false, of those in which an
    /// oracle sees it.
    pub open: Share,
    /// Those that are called consistent or explained.
    pub assured: Share,
    /// Those in which something false is named.
    pub misnamed: Share,
}

impl StrangerRow {
    /// One for each by name, and one for all where there is any.
    pub(super) fn all(judgements: &[Judgement]) -> Vec<Self> {
        let mut named: BTreeMap<&str, Vec<(bool, &Judgement)>> = BTreeMap::new();
        let mut every = Vec::new();
        for judgement in judgements {
            for stranger in &judgement.strangers {
                let one = (stranger.strength.visible(), judgement);
                named.entry(&stranger.name).or_default().push(one);
                every.push(one);
            }
        }
        let all = (!every.is_empty()).then(|| Self::new("all", &every));
        named.iter().map(|(name, trials)| Self::new(name, trials)).chain(all).collect()
    }

    fn new(name: &str, trials: &[(bool, &Judgement)]) -> Self {
        let visible: Vec<&Judgement> =
            trials.iter().filter(|(visible, _)| *visible).map(|(_, one)| *one).collect();
        let assured =
            |one: &Judgement| matches!(one.verdict, Verdict::Consistent | Verdict::Explained);
        Self {
            name: name.to_owned(),
            trials: trials.len(),
            open: Share::of(&visible, |one| {
                (one.is_open() || one.refused.is_some()) && !one.names_falsely()
            }),
            assured: Share::of(&visible, |one| assured(one)),
            misnamed: Share::of(&visible, |one| one.names_falsely()),
        }
    }
}
