use std::collections::BTreeMap;
use std::path::Path;

use serde::Serialize;

use crate::error::BenchmarkError;
use crate::paired::measures::{Measure, TrialQuantity};
use crate::paired::paired_mean::PairedMean;
use crate::paired::paired_share::PairedShare;
use crate::paired::turned::Turned;
use crate::trials::campaign_folder::CampaignFolder;
use crate::trials::record::Record;

/// Two results for the trials of one campaign, compared trial by trial.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PairedComparison {
    /// Hash of the campaign.
    pub campaign: String,
    /// Number of trials in both results.
    pub pairs: usize,
    /// Number of trials in one result only, for each.
    pub alone: [usize; 2],
    /// Number of the common trials that failed, for each result.
    pub failed: [usize; 2],
    /// Yes-or-no measures.
    pub shares: Vec<PairedShare>,
    /// Numeric measures.
    pub means: Vec<PairedMean>,
    /// Trials that the two results answer differently.
    pub turned: Vec<Turned>,
}

impl PairedComparison {
    /// Reads two results and compares the trials that both have. A result is the folder of a campaign or a table that
    /// [`Record::write`] has written. A win is a trial in which the second is better.
    ///
    /// # Errors
    ///
    /// [`BenchmarkError::UnreadableTrials`], [`BenchmarkError::OtherTrials`] where they are of two campaigns,
    /// [`BenchmarkError::NoCommonTrials`], and the errors of reading a folder.
    pub fn read(first: &Path, second: &Path) -> Result<Self, BenchmarkError> {
        let [a, b] = [records(first)?, records(second)?];
        if let (Some(own), Some(other)) = (a.values().next(), b.values().next())
            && own.campaign != other.campaign
        {
            return Err(BenchmarkError::OtherTrials {
                path: second.to_owned(),
                found: other.campaign.clone(),
                planned: own.campaign.clone(),
            });
        }
        Self::of(&a, &b).ok_or_else(|| BenchmarkError::NoCommonTrials {
            first: first.to_owned(),
            second: second.to_owned(),
        })
    }

    /// The comparison of trials by task; a pair must also have equal seeds. `None` without pairs.
    fn of(a: &BTreeMap<usize, Record>, b: &BTreeMap<usize, Record>) -> Option<Self> {
        let pair = |(task, first): (&usize, &'_ Record)| {
            b.get(task).filter(|second| second.seed == first.seed).map(|_| *task)
        };
        let tasks: Vec<usize> = a.iter().filter_map(pair).collect();
        let pairs: Vec<[&Record; 2]> =
            tasks.iter().filter_map(|task| Some([a.get(task)?, b.get(task)?])).collect();
        let share = |measure: Measure| {
            let both =
                |[first, second]: &[&Record; 2]| Some((measure.of(first)?, measure.of(second)?));
            PairedShare::new(measure, &pairs.iter().filter_map(both).collect::<Vec<_>>())
        };
        let mean = |quantity: TrialQuantity| {
            let both =
                |[first, second]: &[&Record; 2]| Some((quantity.of(first)?, quantity.of(second)?));
            PairedMean::new(quantity, &pairs.iter().filter_map(both).collect::<Vec<_>>())
        };
        let count_failures =
            |side: usize| pairs.iter().filter(|pair| pair[side].score.is_err()).count();
        Some(Self {
            campaign: pairs.first()?[0].campaign.clone(),
            pairs: pairs.len(),
            alone: [a.len() - pairs.len(), b.len() - pairs.len()],
            failed: [count_failures(0), count_failures(1)],
            shares: Measure::ALL.map(share).into_iter().filter(|share| share.trials > 0).collect(),
            means: TrialQuantity::ALL.into_iter().filter_map(mean).collect(),
            turned: pairs.iter().filter_map(|[a, b]| Turned::new(a, b)).collect(),
        })
    }
}

/// The trials of a result, by task.
fn records(path: &Path) -> Result<BTreeMap<usize, Record>, BenchmarkError> {
    let merged = path.join("trials.parquet");
    if path.is_dir() && (path.join("campaign.toml").exists() || !merged.exists()) {
        return Ok(CampaignFolder::open(path)?.manifest()?.records);
    }
    let table = if path.is_dir() { merged } else { path.to_owned() };
    let unreadable =
        |reason: String| BenchmarkError::UnreadableTrials { path: table.clone(), reason };
    let mut records = BTreeMap::new();
    for record in Record::read(&table).map_err(unreadable)? {
        let task = record.task;
        if records.insert(task, record).is_some() {
            return Err(unreadable(format!("it holds task {task} twice")));
        }
    }
    let mut campaigns = records.values().map(|record| &record.campaign);
    if let Some(first) = campaigns.next()
        && campaigns.any(|other| other != first)
    {
        return Err(unreadable("it holds trials of two campaigns".to_owned()));
    }
    Ok(records)
}
