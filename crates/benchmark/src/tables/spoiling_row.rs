use std::collections::BTreeMap;

use serde::Serialize;

use crate::panel::judged_spoiling::SpoilingOutcome;
use crate::panel::judgement::Judgement;
use crate::statistics::share::Share;

/// Trials whose logs are spoilt in one way so that an oracle sees it, by what a diagnosis makes of it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SpoilingRow {
    /// Name of the spoiling; `all` for all of them.
    pub name: String,
    /// It says what is spoilt and where.
    pub told_rightly: Share,
    /// It says that something else is, or the same elsewhere.
    pub told_wrongly: Share,
    /// It says what is spoilt and where, and reads the logs as they should be.
    pub read_rightly: Share,
    /// It rejects the logs or leaves them open for another reason.
    pub refused: Share,
    /// It is taken in: it closes the logs or names something false.
    pub taken_in: Share,
}

impl SpoilingRow {
    /// One row for each spoiling by name, and one for all if there is any.
    pub(super) fn all(judgements: &[Judgement]) -> Vec<Self> {
        let mut named: BTreeMap<&str, Vec<SpoilingOutcome>> = BTreeMap::new();
        let mut every = Vec::new();
        for one in judgements.iter().flat_map(|judgement| &judgement.spoilings) {
            named.entry(&one.name).or_default().push(one.outcome);
            every.push(one.outcome);
        }
        let all = (!every.is_empty()).then(|| Self::new("all", &every));
        named.iter().map(|(name, outcomes)| Self::new(name, outcomes)).chain(all).collect()
    }

    fn new(name: &str, outcomes: &[SpoilingOutcome]) -> Self {
        let share = |outcome| Share::of(outcomes, |one| *one == outcome);
        Self {
            name: name.to_owned(),
            told_rightly: share(SpoilingOutcome::ToldRightly),
            told_wrongly: share(SpoilingOutcome::ToldWrongly),
            read_rightly: share(SpoilingOutcome::ReadRightly),
            refused: share(SpoilingOutcome::Refused),
            taken_in: share(SpoilingOutcome::TakenIn),
        }
    }

    /// The shares in the order of [`SpoilingOutcome::ALL`].
    pub fn shares(&self) -> [Share; 5] {
        [self.told_rightly, self.told_wrongly, self.read_rightly, self.refused, self.taken_in]
    }
}
