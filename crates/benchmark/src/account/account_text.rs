use std::collections::{BTreeMap, BTreeSet};

use crate::account::campaign_account::{CampaignAccount, LostInTrial};
use crate::account::loss_stage::LossStage;
use crate::account::lost_name::NameError;
use crate::statistics::text_table::TextTable;

/// Name of the row of all kinds.
const ALL: &str = "all";

impl CampaignAccount {
    /// The tables of stage by kind and the list of all lost names.
    pub fn text(&self) -> String {
        let tables = self.tables().map(|table| table.text(1)).join("\n");
        let lines = self.lost.iter().map(line).collect::<String>();
        format!("{tables}\nlost names, by trial\n{lines}")
    }

    /// Missed visible causes and false findings: the first stage that loses them, by kind.
    pub fn tables(&self) -> [TextTable; 2] {
        [
            self.table(
                NameError::Missed,
                ("missed visible causes: the first stage that loses them", ["visible", "missed"]),
                &self.visible,
            ),
            self.table(
                NameError::False,
                ("false findings: the first stage that would keep them out", ["findings", "false"]),
                &self.findings,
            ),
        ]
    }

    /// One row for each kind with a lost name, and one for all; one column for each stage that loses any.
    fn table(
        &self,
        error: NameError,
        (title, counts): (&str, [&str; 2]),
        of: &BTreeMap<String, usize>,
    ) -> TextTable {
        let lost: Vec<(String, LossStage)> = self
            .lost
            .iter()
            .filter(|lost| lost.name.error == error)
            .map(|lost| (lost.name.at.effect.label(), lost.name.stage))
            .collect();
        let stages: Vec<LossStage> =
            LossStage::ALL.into_iter().filter(|s| lost.iter().any(|(_, own)| own == s)).collect();
        let kinds: BTreeSet<&String> = lost.iter().map(|(kind, _)| kind).collect();
        let row = |kind: Option<&String>| {
            let is_own = |own: &String| kind.is_none_or(|kind| kind == own);
            let all: usize = of.iter().filter(|(own, _)| is_own(own)).map(|(_, n)| n).sum();
            let own: Vec<LossStage> =
                lost.iter().filter(|(own, _)| is_own(own)).map(|(_, stage)| *stage).collect();
            let count = |stage: &LossStage| match own.iter().filter(|own| *own == stage).count() {
                0 => String::new(),
                count => count.to_string(),
            };
            let name = kind.map_or(ALL, String::as_str).to_owned();
            let head = [name, all.to_string(), own.len().to_string()];
            head.into_iter().chain(stages.iter().map(count)).collect()
        };
        let header = [&["kind"][..], &counts].concat();
        let header = header.into_iter().chain(stages.iter().map(|stage| stage.short()));
        TextTable {
            title: title.to_owned(),
            header: header.map(str::to_owned).collect(),
            rows: kinds.into_iter().map(Some).chain([None]).map(row).collect(),
        }
    }
}

/// A lost name in a line.
fn line(LostInTrial { task, name }: &LostInTrial) -> String {
    let seen = name.strength.map_or_else(
        || "false".to_owned(),
        |s| format!("missed, {:.0} sigmas, share {:.3}", s.sigmas, s.share),
    );
    format!("{task:5}  {} ({seen}): {}; {}\n", name.at.words(), name.stage, name.because)
}
