use serde::Serialize;

use crate::panel::judgement::Judgement;
use crate::tables::panel_tally::PanelTally;
use crate::trials::campaign_folder::{CampaignFolder, Manifest};
use crate::trials::failure::Failure;
use crate::trials::kind_count::KindCount;

/// The schema that `tally.json` of a population follows.
pub const PANEL_SCHEMA: &str = "plumbline.panel/1";

/// What the trials of a population come to, and how many there are.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MergedPanel {
    /// Always [`PANEL_SCHEMA`].
    pub schema: &'static str,
    /// The campaign, by its hash.
    pub campaign: String,
    /// How many trials there are.
    pub counts: Vec<KindCount>,
    /// Why trials failed.
    pub failures: Vec<Failure>,
    /// How well the others were answered.
    #[serde(flatten)]
    pub tally: PanelTally,
}

impl MergedPanel {
    /// What has been made of a campaign, whoever made it and in whatever order.
    pub fn new(folder: &CampaignFolder, made: &Manifest) -> Self {
        let judged = made.records.values().filter_map(|record| record.judgement().cloned());
        Self {
            schema: PANEL_SCHEMA,
            campaign: folder.hash().to_owned(),
            counts: KindCount::all(folder, made),
            failures: Failure::all(made),
            tally: PanelTally::of(&judged.collect::<Vec<Judgement>>()),
        }
    }

    /// How many trials there are, and the tables.
    pub fn text(&self) -> String {
        let counts = KindCount::table(&self.counts);
        let failures = self.failures.iter().map(Failure::words).collect::<String>();
        format!("{}\n{}{failures}", counts.text(1), self.tally.text())
    }
}
