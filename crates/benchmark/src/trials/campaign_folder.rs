use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use document::Document;

use crate::error::BenchmarkError;
use crate::trial_folder::unusable;
use crate::trials::campaign::Campaign;
use crate::trials::part::Part;
use crate::trials::record::Record;

const CAMPAIGN: &str = "campaign.toml";
const SCENARIO: &str = "scenario.toml";
const SHARDS: &str = "shards";
const SHARD: &str = "parquet";

/// The folder of a campaign.
///
/// ```text
/// campaign.toml                  what is to be made, with all that it extends
/// scenario.toml                  the scenario that it starts from, if it starts from one
/// shards/00012.parquet           a finished trial, by its task
/// work/                          trials that are being made
/// logs/KIND/SEED/                their logs, where they are kept
/// slurm/                         job of `plumbline-bench submit` and what its tasks have said
/// ```
///
/// Trials without a shard are still to be made.
#[derive(Debug, Clone)]
pub struct CampaignFolder {
    root: PathBuf,
    campaign: Campaign,
    hash: String,
}

/// The finished trials of a campaign, and the unusable files among the shards.
#[derive(Debug, Clone, PartialEq)]
pub struct Manifest {
    /// The finished trials by task, including the failed ones.
    pub records: BTreeMap<usize, Record>,
    /// Files among the shards that do not belong to this campaign, by path.
    pub broken: Vec<BrokenShard>,
}

/// A file among the shards that does not belong to this campaign.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct BrokenShard {
    /// The file.
    pub path: PathBuf,
    /// What is wrong with it.
    pub reason: String,
}

impl CampaignFolder {
    /// Puts a campaign into a folder, which is created if it is missing.
    ///
    /// # Errors
    ///
    /// [`BenchmarkError::OtherCampaign`] when the folder holds trials of another campaign, and the errors of reading
    /// and writing it.
    pub fn plan(root: &Path, campaign: Campaign) -> Result<Self, BenchmarkError> {
        let folder = Self::of(root, campaign);
        for path in folder.shards()? {
            let records = Record::read(&path).unwrap_or_default();
            let others = records.iter().find(|record| record.campaign != folder.hash);
            if let Some(other) = others {
                let (found, planned) = (other.campaign.clone(), folder.hash);
                return Err(BenchmarkError::OtherCampaign { path, found, planned });
            }
        }
        std::fs::create_dir_all(root).map_err(unusable(root))?;
        let campaign = &folder.campaign;
        if let Some(scenario) = campaign.scenario() {
            write(&root.join(SCENARIO), scenario)?;
        }
        write(&root.join(CAMPAIGN), &campaign.self_contained_text(SCENARIO))?;
        Ok(folder)
    }

    /// The folder of a campaign that was planned.
    ///
    /// # Errors
    ///
    /// [`BenchmarkError::NoCampaign`] and the errors of [`Campaign::from_document`].
    pub fn open(root: &Path) -> Result<Self, BenchmarkError> {
        if !root.join(CAMPAIGN).exists() {
            return Err(BenchmarkError::NoCampaign { path: root.to_owned() });
        }
        let document = Document::read(root.join(CAMPAIGN))?;
        Ok(Self::of(root, Campaign::from_document(&document)?))
    }

    fn of(root: &Path, campaign: Campaign) -> Self {
        Self { root: root.to_owned(), hash: campaign.hash(), campaign }
    }

    /// Adds finished trials of the campaign, as [`read_finished`] returns them. Existing shards stay. Returns the
    /// number of added trials.
    ///
    /// # Errors
    ///
    /// The errors of writing a shard.
    pub fn take(&self, records: &[Record]) -> Result<usize, BenchmarkError> {
        let new: Vec<&Record> = records.iter().filter(|record| !self.holds(record.task)).collect();
        new.iter().try_for_each(|record| self.keep(record))?;
        Ok(new.len())
    }

    /// Its path.
    pub fn root(&self) -> &Path {
        &self.root
    }

    /// The campaign.
    pub fn campaign(&self) -> &Campaign {
        &self.campaign
    }

    /// Identity of the campaign.
    pub fn hash(&self) -> &str {
        &self.hash
    }

    /// The files that define the campaign.
    pub fn plans(&self) -> Vec<PathBuf> {
        let scenario = self.campaign.scenario().map(|_| SCENARIO);
        [Some(CAMPAIGN), scenario].into_iter().flatten().map(|name| self.root.join(name)).collect()
    }

    /// Reads every shard.
    ///
    /// # Errors
    ///
    /// [`BenchmarkError::TrialFolder`] when the folder of the shards cannot be listed.
    pub fn manifest(&self) -> Result<Manifest, BenchmarkError> {
        let mut made = Manifest { records: BTreeMap::new(), broken: Vec::new() };
        for path in self.shards()? {
            match self.read(&path) {
                Ok(record) => {
                    made.records.insert(record.task, record);
                }
                Err(reason) => made.broken.push(BrokenShard { path, reason }),
            }
        }
        Ok(made)
    }

    /// The tasks of a part that are still to be made.
    ///
    /// # Errors
    ///
    /// The errors of [`manifest`](Self::manifest).
    pub fn remaining(&self, part: Part) -> Result<Vec<usize>, BenchmarkError> {
        let made = self.manifest()?.records;
        let all = (0..self.campaign.trials()).filter(|task| part.holds(*task));
        Ok(all.filter(|task| !made.contains_key(task)).collect())
    }

    /// Whether a task has its shard.
    pub(super) fn holds(&self, task: usize) -> bool {
        self.read(&self.shard(task)).is_ok()
    }

    /// Path of the shard of a task.
    pub fn shard(&self, task: usize) -> PathBuf {
        self.root.join(SHARDS).join(format!("{task:05}.{SHARD}"))
    }

    /// A folder inside it, which is created if it is missing.
    pub(crate) fn folder(&self, name: &str) -> Result<PathBuf, BenchmarkError> {
        let folder = self.root.join(name);
        std::fs::create_dir_all(&folder).map_err(unusable(&folder))?;
        Ok(folder)
    }

    /// Writes the shard of a trial.
    pub(super) fn keep(&self, record: &Record) -> Result<(), BenchmarkError> {
        self.folder(SHARDS)?;
        Ok(Record::write(&self.shard(record.task), std::slice::from_ref(record))?)
    }

    /// Path of the scenario that every trial starts from, if there is one.
    pub(super) fn scenario(&self) -> PathBuf {
        self.root.join(SCENARIO)
    }

    /// The files among the shards, in the order of their names.
    fn shards(&self) -> Result<Vec<PathBuf>, BenchmarkError> {
        let folder = self.root.join(SHARDS);
        let entries = match std::fs::read_dir(&folder) {
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(Vec::new()),
            entries => entries.map_err(unusable(&folder))?,
        };
        let paths = entries.map(|entry| entry.map(|entry| entry.path()));
        let mut paths = paths.collect::<Result<Vec<_>, _>>().map_err(unusable(&folder))?;
        paths.retain(|path| path.extension().is_some_and(|e| e == SHARD));
        paths.sort();
        Ok(paths)
    }

    /// The record in a shard, or in words why it does not belong to this campaign. A shard that cannot be read is read once
    /// more: a disk that answers then has lost nothing.
    fn read(&self, path: &Path) -> Result<Record, String> {
        let mut records = Record::read(path).or_else(|_| Record::read(path))?;
        let (Some(record), true) = (records.pop(), records.is_empty()) else {
            return Err("it does not hold one trial".to_owned());
        };
        if record.campaign != self.hash {
            return Err("it is of another campaign".to_owned());
        }
        if record.task >= self.campaign.trials() || path != self.shard(record.task) {
            return Err(format!("it is that of task {}", record.task));
        }
        Ok(record)
    }
}

/// The finished trials of a campaign in a table that [`Record::write`] has written, such as the
/// `trials.parquet` of another folder.
///
/// # Errors
///
/// [`BenchmarkError::UnreadableTrials`] and [`BenchmarkError::OtherTrials`].
pub fn read_finished(campaign: &Campaign, table: &Path) -> Result<Vec<Record>, BenchmarkError> {
    let path = || table.to_owned();
    let unreadable = |reason| BenchmarkError::UnreadableTrials { path: path(), reason };
    let records = Record::read(table).map_err(unreadable)?;
    let planned = campaign.hash();
    for record in &records {
        if record.campaign != planned {
            let found = record.campaign.clone();
            return Err(BenchmarkError::OtherTrials { path: path(), found, planned });
        }
        if record.task >= campaign.trials() {
            return Err(unreadable(format!("it holds a task {}", record.task)));
        }
    }
    Ok(records)
}

fn write(path: &Path, text: &str) -> Result<(), BenchmarkError> {
    Ok(logs::replace_file(path, |file| Ok(std::io::Write::write_all(file, text.as_bytes())?))?)
}
