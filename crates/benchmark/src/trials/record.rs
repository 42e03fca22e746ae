use crate::panel::judgement::Judgement;
use crate::trials::hidden::Hidden;

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
    /// The judgement, or in words why there is none.
    pub score: Result<Box<Judgement>, String>,
}

impl Record {
    /// The judgement, if there is one.
    pub fn judgement(&self) -> Option<&Judgement> {
        self.score.as_deref().ok()
    }
}
