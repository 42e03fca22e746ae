use experiment::Score;
use serde::Serialize;

use crate::panel::judgement::Judgement;
use crate::trials::hidden::Hidden;

/// How well a trial was answered.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Scored {
    /// One of a scenario.
    Scenario(Box<Score>),
    /// One of a population.
    Panel(Box<Judgement>),
}

impl Scored {
    /// Reads what was written as JSON: of a scenario where something, or nothing, was hidden in its arm.
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
