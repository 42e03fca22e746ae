use std::collections::BTreeMap;

use diagnosis::Verdict;
use serde::Serialize;

use crate::panel::judgement::Judgement;
use crate::statistics::share::Share;

/// Trials whose data contain one effect of no catalogue, or one that the diagnosis does not look for, and whose logs are
/// not spoilt.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct StrangerRow {
    /// Name of the effect; `all` for all of them.
    pub name: String,
    /// Number of these trials.
    pub trials: usize,
    /// Trials in which the diagnosis leaves structure open, or rejects the logs, and names nothing false, of those in
    /// which an oracle detects the effect.
    pub open: Share,
    /// Trials that are called consistent or explained.
    pub assured: Share,
    /// Trials in which something false is named.
    pub misnamed: Share,
}

impl StrangerRow {
    /// One row for each effect by name, and one for all if there is any.
    pub(super) fn all(judgements: &[Judgement]) -> Vec<Self> {
        let mut named: BTreeMap<&str, Vec<(bool, &Judgement)>> = BTreeMap::new();
        let mut every = Vec::new();
        for judgement in judgements.iter().filter(|one| !one.is_spoilt()) {
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
            open: Share::of(&visible, |one| one.abstains()),
            assured: Share::of(&visible, |one| assured(one)),
            misnamed: Share::of(&visible, |one| one.names_falsely()),
        }
    }
}
