use experiment::Score;

use crate::panel::judgement::Judgement;
use crate::trials::hidden::Hidden;
use crate::trials::scored::Scored;

/// The result of one trial of a campaign, a row of a table.
#[derive(Debug, Clone, PartialEq)]
pub struct Record {
    /// Index of the trial in the campaign, from 0.
    pub task: usize,
    /// The hidden effects in the arm of a scenario; `None` for a trial of a population.
    pub hidden: Option<Hidden>,
    /// The seed of all random draws.
    pub seed: u64,
    /// Hash of the campaign.
    pub campaign: String,
    /// The score, or in words why there is none.
    pub score: Result<Scored, String>,
}

impl Record {
    /// The score of a trial of a scenario, if there is one.
    pub fn scenario_score(&self) -> Option<&Score> {
        match self.score.as_ref().ok()? {
            Scored::Scenario(score) => Some(score),
            Scored::Panel(_) => None,
        }
    }

    /// The judgement of a trial of a population, if there is one.
    pub fn judgement(&self) -> Option<&Judgement> {
        match self.score.as_ref().ok()? {
            Scored::Scenario(_) => None,
            Scored::Panel(judgement) => Some(judgement),
        }
    }
}
