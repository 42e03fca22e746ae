use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use crate::account::lost_name::LostName;
use crate::account::trial_account::TrialAccount;
use crate::error::BenchmarkError;
use crate::panel::judgement::Judgement;
use crate::trials::campaign_folder::{CampaignFolder, Manifest};
use crate::trials::hash::hexadecimal;

/// The schema that `account.json` follows.
pub const ACCOUNT_SCHEMA: &str = "plumbline.account/1";

/// Folder of the accounts of single trials, in that of the campaign.
pub(super) const FOLDER: &str = "accounts";

/// The accounts of the trials of a campaign.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CampaignAccount {
    /// Always [`ACCOUNT_SCHEMA`].
    pub schema: &'static str,
    /// Identity of the campaign.
    pub campaign: String,
    /// Number of trials with an account.
    pub trials: usize,
    /// Number of judged simulated trials without one.
    pub left: usize,
    /// Trials whose account cannot be made, with the reason.
    pub failed: BTreeMap<usize, String>,
    /// Trials of which another program has made the judgement, with the findings that are not found again.
    pub made_otherwise: BTreeMap<usize, Vec<String>>,
    /// Lost names by trial.
    pub lost: Vec<LostInTrial>,
    /// Visible causes by code of the kind.
    #[serde(skip)]
    pub(super) visible: BTreeMap<String, usize>,
    /// Findings by code of the kind, where all causes are known.
    #[serde(skip)]
    pub(super) findings: BTreeMap<String, usize>,
}

/// A lost name and its trial.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LostInTrial {
    /// Index of the trial.
    pub task: usize,
    /// The name.
    #[serde(flatten)]
    pub name: LostName,
}

/// The account of a trial as a file, with the judgement that it is about.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct AccountShard {
    /// SHA-256 of campaign, findings and causes.
    judged: String,
    account: Result<TrialAccount, String>,
}

impl AccountShard {
    pub fn new(
        campaign: &str,
        judgement: &Judgement,
        account: Result<TrialAccount, String>,
    ) -> Self {
        Self { judged: identity(campaign, judgement), account }
    }

    /// Path of the file of a task.
    pub fn path(root: &Path, task: usize) -> PathBuf {
        root.join(FOLDER).join(format!("{task:05}.json"))
    }

    /// The account in a file, if it is one of this judgement.
    pub fn read(
        path: &Path,
        campaign: &str,
        judgement: &Judgement,
    ) -> Option<Result<TrialAccount, String>> {
        let text = files::text(path, files::KEPT_BYTES).ok()?;
        let shard: Self = serde_json::from_str(&text).ok()?;
        (shard.judged == identity(campaign, judgement)).then_some(shard.account)
    }

    /// Puts the file in its place.
    pub fn write(&self, path: &Path) -> Result<(), BenchmarkError> {
        // What is made of numbers and texts can be written as JSON.
        let text = serde_json::to_string_pretty(self).unwrap_or_default();
        Ok(logs::replace_file(path, |file| Ok(std::io::Write::write_all(file, text.as_bytes())?))?)
    }
}

/// What an account hangs on: the campaign, and what was found and missed.
fn identity(campaign: &str, judgement: &Judgement) -> String {
    let judged = (&judgement.findings, &judgement.causes, &judgement.refused);
    hexadecimal(&format!("{campaign}\n{}", serde_json::to_string(&judged).unwrap_or_default()))
}

impl CampaignAccount {
    /// The accounts that lie in the folder of a campaign.
    pub fn read(folder: &CampaignFolder, made: &Manifest) -> Self {
        let mut all = Self {
            schema: ACCOUNT_SCHEMA,
            campaign: folder.hash().to_owned(),
            trials: 0,
            left: 0,
            failed: BTreeMap::new(),
            made_otherwise: BTreeMap::new(),
            lost: Vec::new(),
            visible: BTreeMap::new(),
            findings: BTreeMap::new(),
        };
        for (task, judgement) in simulated_trials(made) {
            let path = AccountShard::path(folder.root(), task);
            match AccountShard::read(&path, folder.hash(), judgement) {
                None => all.left += 1,
                Some(Err(reason)) => {
                    all.failed.insert(task, reason);
                }
                Some(Ok(account)) => all.add(task, judgement, account),
            }
        }
        all
    }

    /// Adds the account of a trial.
    pub fn add(&mut self, task: usize, judgement: &Judgement, account: TrialAccount) {
        self.trials += 1;
        for cause in judgement.visible() {
            *self.visible.entry(cause.at.effect.label()).or_default() += 1;
        }
        for finding in judgement.findings.iter().filter(|_| judgement.is_all_known()) {
            *self.findings.entry(finding.at.effect.label()).or_default() += 1;
        }
        if !account.not_found_again.is_empty() {
            self.made_otherwise.insert(task, account.not_found_again);
        }
        self.lost.extend(account.lost.into_iter().map(|name| LostInTrial { task, name }));
    }
}

/// The judged trials whose logs were simulated. What is in recorded logs is not known.
pub(super) fn simulated_trials(made: &Manifest) -> impl Iterator<Item = (usize, &Judgement)> {
    let judged =
        made.records.iter().filter_map(|(task, record)| Some((*task, record.judgement()?)));
    judged.filter(|(_, judgement)| judgement.is_all_known())
}
