use serde::Serialize;

use crate::statistics::text_table::TextTable;
use crate::trials::campaign_folder::{CampaignFolder, Manifest};
use crate::trials::hidden::Hidden;

/// Progress of the trials of a kind.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct KindCount {
    /// The hidden effects; `all` in the last entry.
    pub hidden: String,
    /// Number of trials with a score.
    pub made: usize,
    /// Number of trials that could not be simulated or diagnosed.
    pub failed: usize,
    /// Number of trials whose shard is broken or of another campaign.
    pub broken: usize,
    /// Number of trials without a shard.
    pub left: usize,
}

impl KindCount {
    /// One entry for every kind of a campaign, in its order, and one for all kinds. A population has only the latter.
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

    /// The counts as a table, one row each.
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

    /// Number of trials that are still to be made, or to be made again.
    pub fn open(&self) -> usize {
        self.broken + self.left
    }

    /// Number of all trials.
    pub fn trials(&self) -> usize {
        self.made + self.failed + self.open()
    }
}
