use experiment::Score;
use serde::Serialize;

use crate::panel::judgement::Judgement;
use crate::trials::hidden::Hidden;

/// How well a trial was answered.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Scored {
    /// The score of a trial of a scenario.
    Scenario(Box<Score>),
    /// The judgement of a trial of a population.
    Panel(Box<Judgement>),
}

impl Scored {
    /// Reads a score from JSON: that of a scenario where `hidden` is given.
    pub(super) fn from_json(json: &str, hidden: Option<Hidden>) -> Result<Self, String> {
        let read = match hidden {
            Some(_) => serde_json::from_str(json).map(Self::Scenario),
            None => serde_json::from_str(json).map(Self::Panel),
        };
        read.map_err(|e| format!("its score is none: {e}"))
    }
}

impl From<Score> for Scored {
    fn from(score: Score) -> Self {
        Self::Scenario(Box::new(score))
    }
}

impl From<Judgement> for Scored {
    fn from(judgement: Judgement) -> Self {
        Self::Panel(Box::new(judgement))
    }
}
