use std::collections::BTreeSet;

use crate::statistics::text_table::TextTable;
use crate::tables::tally::{NOTHING, Tally, TallyRow, TrialGroup};

/// The first finding against the injected effects.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Confusion {
    /// The columns: codes, and `nothing` at the end.
    pub named: Vec<&'static str>,
    /// The rows: the injected effects, the index of their own column if they have one, and how often each column was
    /// named.
    pub injected: Vec<(TrialGroup, Option<usize>, Vec<usize>)>,
}

impl Tally {
    /// The confusion table. Its rows are single effects by kind, two effects, an unknown effect and none; its columns
    /// are the first findings.
    pub fn confusion(&self) -> Confusion {
        let rows = || self.rows.iter().filter(|row| row.injected != TrialGroup::One);
        let own = |row: &TallyRow| match row.injected {
            TrialGroup::Kind(kind) => Some(kind.code()),
            TrialGroup::Clean => Some(NOTHING),
            TrialGroup::One | TrialGroup::Two | TrialGroup::Unknown => None,
        };
        let mut codes: BTreeSet<&str> =
            rows().flat_map(|row| row.named_first.keys().copied().chain(own(row))).collect();
        codes.remove(NOTHING);
        let named: Vec<&str> = codes.into_iter().chain([NOTHING]).collect();
        let count = |row: &TallyRow, code: &&str| row.named_first.get(code).copied().unwrap_or(0);
        let row = |row: &TallyRow| {
            let own = own(row).and_then(|own| named.iter().position(|code| *code == own));
            (row.injected, own, named.iter().map(|code| count(row, code)).collect())
        };
        Confusion { injected: rows().map(row).collect(), named }
    }
}

impl Confusion {
    /// The table as text, with codes on two lines.
    pub(super) fn table(&self) -> TextTable {
        // A code on two lines: the family above the number.
        let two_lines = |code: &&str| match code.split_at_checked(2) {
            Some((family, number)) if *code != NOTHING => format!("{family}\n{number}"),
            _ => "none".to_owned(),
        };
        let row = |(injected, _, counts): &(TrialGroup, Option<usize>, Vec<usize>)| {
            let name = match injected {
                TrialGroup::Kind(kind) => kind.code().to_owned(),
                other => other.to_string(),
            };
            let count =
                |count: &usize| if *count == 0 { ".".to_owned() } else { count.to_string() };
            std::iter::once(name).chain(counts.iter().map(count)).collect()
        };
        let title = "named first, a column a code; `none` where nothing was";
        TextTable {
            title: title.to_owned(),
            header: std::iter::once("put in".to_owned())
                .chain(self.named.iter().map(two_lines))
                .collect(),
            rows: self.injected.iter().map(row).collect(),
        }
    }
}
