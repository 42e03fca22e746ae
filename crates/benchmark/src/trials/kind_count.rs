use serde::Serialize;

use crate::statistics::text_table::TextTable;
use crate::trials::campaign_folder::{CampaignFolder, Manifest};
use crate::trials::hidden::Hidden;

/// How far the trials of a kind are.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct KindCount {
    /// What is hidden; `all` at the end.
    pub hidden: String,
    /// Trials with a score.
    pub made: usize,
    /// Trials that could not be simulated or diagnosed.
    pub failed: usize,
    /// Trials whose shard is broken or of another campaign.
    pub broken: usize,
    /// Trials without a shard.
    pub left: usize,
}

impl KindCount {
    /// One for every kind of a campaign, in its order, and one for all of them; of a population that alone.
    pub fn all(folder: &CampaignFolder, made: &Manifest) -> Vec<Self> {
        let campaign = folder.campaign();
        let of = |hidden: Option<Hidden>| {
            let name = hidden.map_or("all".to_owned(), |hidden| hidden.to_string());
            let mut count = Self { hidden: name, made: 0, failed: 0, broken: 0, left: 0 };
            let own =
                |task: &usize| hidden.is_none_or(|hidden| campaign.task(*task).0 == Some(hidden));
            for task in (0..campaign.trials()).filter(own) {
                let shard = folder.shard(task);
                match made.records.get(&task) {
                    Some(record) if record.score.is_ok() => count.made += 1,
                    Some(_) => count.failed += 1,
                    None if made.broken.iter().any(|b| b.path == shard) => count.broken += 1,
                    None => count.left += 1,
                }
            }
            count
        };
        campaign.kinds().iter().map(|kind| of(Some(*kind))).chain([of(None)]).collect()
    }

    /// A row for each.
    pub fn table(counts: &[Self]) -> TextTable {
        let row = |count: &Self| {
            let numbers = [count.made, count.failed, count.broken, count.left];
            let numbers = numbers.iter().map(usize::to_string);
            std::iter::once(count.hidden.clone()).chain(numbers).collect()
        };
        TextTable {
            title: "trials".to_owned(),
            header: ["hidden", "made", "failed", "broken", "left"].map(str::to_owned).to_vec(),
            rows: counts.iter().map(row).collect(),
        }
    }

    /// Trials that are still to be made, or to be made again.
    pub fn open(&self) -> usize {
        self.broken + self.left
    }

    /// All of them.
    pub fn trials(&self) -> usize {
        self.made + self.failed + self.open()
    }
}
