use crate::statistics::text_table::TextTable;
use crate::tables::tally::{SizeTally, Tally, TallyRow};

impl Tally {
    /// Three tables within 120 columns, for counts below 1000: the right answers, the first findings against the
    /// injected effects, and the errors of the sizes.
    pub fn text(&self) -> String {
        let [shares, sizes] = self.tables();
        [shares.text(1), self.confusion().table().text(0), sizes.text(1)].join("\n")
    }

    /// The right answers, and the errors of the sizes.
    pub fn tables(&self) -> [TextTable; 2] {
        [self.shares(), self.sizes()]
    }

    fn shares(&self) -> TextTable {
        let header =
            ["put in", "trials", "exactly", "if visible", "as one of", "found", "unknown", "stray"];
        let row = |row: &TallyRow| {
            let shares =
                [row.exactly, row.visibly, row.as_one_of, row.found, row.unknown, row.stray];
            let mut cells = vec![row.injected.to_string(), row.trials.to_string()];
            cells.extend(shares.map(|share| share.words()));
            cells
        };
        TextTable {
            title: "shares with their 95 % score intervals (%)".to_owned(),
            header: header.map(str::to_owned).to_vec(),
            rows: self.rows.iter().map(row).collect(),
        }
    }

    fn sizes(&self) -> TextTable {
        let header = ["put in", "parameter", "estimates", "determined", "median error", "covered"];
        let row = |(row, size): (&TallyRow, &SizeTally)| {
            let error = size.median_error.map_or("-".to_owned(), |e| format!("{:.1} %", 100.0 * e));
            vec![
                row.injected.to_string(),
                size.name.clone(),
                size.estimates.to_string(),
                size.determined.to_string(),
                error,
                size.covered.words(),
            ]
        };
        let sizes = self.rows.iter().flat_map(|row| row.sizes.iter().map(move |size| (row, size)));
        let sizes = sizes.filter(|(_, size)| size.estimates > 0);
        let title = "sizes, where the effect was named at its place; errors and intervals of those \
                     determined";
        TextTable {
            title: title.to_owned(),
            header: header.map(str::to_owned).to_vec(),
            rows: sizes.map(row).collect(),
        }
    }
}
