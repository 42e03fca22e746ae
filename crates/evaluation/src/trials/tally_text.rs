use std::collections::BTreeSet;

use comfy_table::{CellAlignment, ContentArrangement, Table, presets};

use super::tally::NOTHING;
use super::{Group, Row, SizeTally, Tally};

impl Tally {
    /// Three tables within 120 columns, for counts below 1000: how often it was right, what was
    /// named first for what was put in, and how good the sizes are.
    pub fn text(&self) -> String {
        format!(
            "shares with their 95 % score intervals (%)\n{}\n\
             named first, a column a code; `nothing` where nothing was\n{}\n\
             sizes, where the effect was named at its place; errors and intervals of those determined\n{}",
            self.shares(),
            self.confusion(),
            self.sizes()
        )
    }

    fn shares(&self) -> String {
        let header = ["put in", "trials", "exactly", "as one of", "found", "unknown", "stray"]
            .map(str::to_owned);
        let row = |row: &Row| {
            let shares = [row.exactly, row.as_one_of, row.found, row.unknown, row.stray];
            let mut cells = vec![row.put_in.to_string(), row.trials.to_string()];
            cells.extend(shares.map(|share| share.words()));
            cells
        };
        table(header.to_vec(), self.rows.iter().map(row), 1)
    }

    /// The rows of kinds, of two effects and of none; the columns of what was named.
    fn confusion(&self) -> String {
        let rows = || self.rows.iter().filter(|row| row.put_in != Group::One);
        let own = |row: &Row| match row.put_in {
            Group::Kind(kind) => Some(kind.code()),
            _ => None,
        };
        let mut codes: BTreeSet<&str> =
            rows().flat_map(|row| row.named_first.keys().copied().chain(own(row))).collect();
        codes.remove(NOTHING);
        let columns: Vec<&str> = codes.into_iter().chain([NOTHING]).collect();
        // A code on two lines: the family above the number.
        let two_lines = |code: &str| match code.split_at_checked(2) {
            Some((family, number)) if code != NOTHING => format!("{family}\n{number}"),
            _ => code.to_owned(),
        };
        let header =
            std::iter::once("put in".to_owned()).chain(columns.iter().map(|c| two_lines(c)));
        let row = |row: &Row| {
            let name = own(row).map_or_else(|| row.put_in.to_string(), str::to_owned);
            let count =
                |code: &&str| row.named_first.get(code).map_or(".".to_owned(), usize::to_string);
            std::iter::once(name).chain(columns.iter().map(count)).collect()
        };
        table(header.collect(), rows().map(row), 0)
    }

    fn sizes(&self) -> String {
        let header = ["put in", "parameter", "estimates", "determined", "median error", "covered"];
        let row = |(row, size): (&Row, &SizeTally)| {
            let error = size.median_error.map_or("-".to_owned(), |e| format!("{:.1} %", 100.0 * e));
            vec![
                row.put_in.to_string(),
                size.name.clone(),
                size.estimates.to_string(),
                size.determined.to_string(),
                error,
                size.covered.words(),
            ]
        };
        let sizes = self.rows.iter().flat_map(|row| row.sizes.iter().map(move |size| (row, size)));
        let sizes = sizes.filter(|(_, size)| size.estimates > 0);
        table(header.map(str::to_owned).to_vec(), sizes.map(row), 1)
    }
}

/// A table without lines, all but the first column to the right.
fn table(header: Vec<String>, rows: impl Iterator<Item = Vec<String>>, padding: u16) -> String {
    let mut table = Table::new();
    table.load_style(presets::NOTHING).set_content_arrangement(ContentArrangement::Disabled);
    table.set_header(header).add_rows(rows);
    for (index, column) in table.column_iter_mut().enumerate() {
        column.set_padding((padding, 1));
        let alignment = if index == 0 { CellAlignment::Left } else { CellAlignment::Right };
        column.set_cell_alignment(alignment);
    }
    table.lines().map(|line| format!("{}\n", line.trim_end())).collect()
}
