use serde::Serialize;

use crate::alarms::alarm_ledger::AlarmLedger;
use crate::panel::judgement::Judgement;
use crate::tables::panel_tally::PanelTally;
use crate::trials::campaign_folder::{CampaignFolder, Manifest};
use crate::trials::failure::Failure;
use crate::trials::kind_count::KindCount;

/// The schema that `tally.json` follows.
pub const PANEL_SCHEMA: &str = "plumbline.panel/2";

/// The results of the trials of a campaign, and their numbers.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MergedPanel {
    /// Always [`PANEL_SCHEMA`].
    pub schema: &'static str,
    /// Hash of the campaign.
    pub campaign: String,
    /// Number of trials, by kind where there are kinds, and in all.
    pub counts: Vec<KindCount>,
    /// Why trials failed.
    pub failures: Vec<Failure>,
    /// How well the other trials were answered.
    #[serde(flatten)]
    pub tally: PanelTally,
    /// What was said of clean logs.
    pub alarms: AlarmLedger,
}

impl MergedPanel {
    /// The results of a campaign, independent of who made the trials and of their order.
    pub fn new(folder: &CampaignFolder, made: &Manifest) -> Self {
        let judged = made.records.values().filter_map(|record| record.judgement().cloned());
        let judged: Vec<Judgement> = judged.collect();
        Self {
            schema: PANEL_SCHEMA,
            campaign: folder.hash().to_owned(),
            counts: KindCount::all(folder, made),
            failures: Failure::all(made),
            tally: PanelTally::of(&judged),
            alarms: AlarmLedger::of(&judged),
        }
    }

    /// Number of all trials, the tables, and the ledger of false alarms.
    pub fn text(&self) -> String {
        let counts = KindCount::table(&self.counts[self.counts.len().saturating_sub(1)..]);
        let failures = self.failures.iter().map(Failure::words).collect::<String>();
        format!("{}\n{}{}{failures}", counts.text(1), self.tally.text(), self.alarms.text())
    }
}
