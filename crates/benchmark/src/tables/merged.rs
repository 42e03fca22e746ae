use experiment::Score;
use serde::Serialize;

use crate::statistics::text_table::TextTable;
use crate::tables::gained::Gained;
use crate::tables::power::{Power, SizeClass};
use crate::tables::tally::Tally;
use crate::trials::campaign_folder::{CampaignFolder, Manifest};
use crate::trials::failure::Failure;
use crate::trials::kind_count::KindCount;

/// The schema that `tally.json` follows.
pub const MERGED_SCHEMA: &str = "plumbline.trials/1";

/// The results of all trials of a campaign.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Merged {
    /// Always [`MERGED_SCHEMA`].
    pub schema: &'static str,
    /// Hash of the campaign.
    pub campaign: String,
    /// Number of trials, by kind and in all.
    pub counts: Vec<KindCount>,
    /// Why trials failed.
    pub failures: Vec<Failure>,
    /// How well the other trials were diagnosed.
    #[serde(flatten)]
    pub tally: Tally,
    /// How often effects are named, by their size.
    pub power: Vec<Power>,
    /// The gains of naming effects, where they were measured.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub gained: Vec<Gained>,
}

impl Merged {
    /// The results of a campaign, independent of who made the trials and of their order.
    pub fn new(folder: &CampaignFolder, made: &Manifest) -> Self {
        let scores: Vec<Score> =
            made.records.values().filter_map(|record| record.scenario_score().cloned()).collect();
        Self {
            schema: MERGED_SCHEMA,
            campaign: folder.hash().to_owned(),
            counts: KindCount::all(folder, made),
            failures: Failure::all(made),
            tally: Tally::of(&scores),
            power: Power::all(&scores),
            gained: Gained::all(&scores),
        }
    }

    /// Numbers of trials, results of the diagnosis, and results by size.
    pub fn text(&self) -> String {
        let counts = KindCount::table(&self.counts[self.counts.len().saturating_sub(1)..]);
        let mut text =
            format!("{}\n{}\n{}", counts.text(1), self.tally.text(), self.powers().text(1));
        if let Some(gained) = self.gain_table() {
            text.push_str(&format!("\n{}", gained.text(1)));
        }
        self.failures.iter().for_each(|failure| text.push_str(&failure.words()));
        text
    }

    /// The gains of naming effects, where they were measured.
    pub fn gain_table(&self) -> Option<TextTable> {
        (!self.gained.is_empty()).then(|| Gained::table(&self.gained))
    }

    /// How often an effect is named first, in three classes of equal number by its size.
    pub fn powers(&self) -> TextTable {
        let class = |class: &SizeClass| {
            let [low, high] = class.sizes.map(short);
            let sizes = if low == high { low } else { format!("{low}-{high}") };
            format!("{sizes}: {}/{}", class.exactly.count, class.exactly.of)
        };
        let row = |power: &Power| {
            let unit = if power.unit == "1" { String::new() } else { format!(" ({})", power.unit) };
            let mut cells = vec![power.injected.to_string(), format!("{}{unit}", power.parameter)];
            cells.extend(power.classes.iter().map(class));
            cells.resize(5, "-".to_owned());
            cells
        };
        let header = ["put in", "size", "smallest third", "middle", "largest"];
        TextTable {
            title: "named exactly, by the size that was put in".to_owned(),
            header: header.map(str::to_owned).to_vec(),
            rows: self.power.iter().map(row).collect(),
        }
    }
}

/// Two significant digits, without trailing zeros.
fn short(number: f64) -> String {
    let rounded: Result<f64, _> = format!("{number:.1e}").parse();
    rounded.unwrap_or(number).to_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_digits_of_a_number_count() {
        let numbers = [0.000_345_6, 0.0996, 1.26, 99.6, 12_345.0, 0.0];
        assert_eq!(numbers.map(short), ["0.00035", "0.1", "1.3", "100", "12000", "0"]);
    }
}
