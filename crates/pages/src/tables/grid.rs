use anstyle::Style;

use crate::text::numbers::significant;
use crate::text::terminal::{BOLD, FAINT, TERMINAL_WIDTH};

/// Significant digits of every number of a table.
pub const TABLE_DIGITS: usize = 3;

/// A column of a [`text_grid`].
pub struct GridColumn {
    /// What it is.
    pub header: String,
    /// Its cells, row by row.
    pub cells: Vec<Cell>,
}

/// What stands in one place of a [`text_grid`].
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Cell {
    /// Its text.
    pub text: String,
    /// How it is told from the others of its row.
    pub style: Style,
}

impl Cell {
    /// A cell like any other.
    pub fn plain(text: String) -> Self {
        Self { text, style: Style::new() }
    }

    /// A cell that stands out.
    pub fn best(text: String) -> Self {
        Self { text, style: BOLD }
    }

    /// Whether it stands out.
    pub fn is_best(&self) -> bool {
        self.style == BOLD
    }

    /// Its text where looks tell it from others, without the star and what makes room for it.
    pub fn value(&self) -> &str {
        self.text.trim_end_matches(['*', ' '])
    }
}

/// Numbers beside each other, a star at those that show the least of them.
pub fn mark_least(values: &[f64]) -> Vec<Cell> {
    let least = values.iter().copied().filter(|v| v.is_finite()).min_by(f64::total_cmp);
    let least = least.map(|value| significant(value, TABLE_DIGITS));
    let cells = values.iter().map(|&value| {
        let shown = significant(value, TABLE_DIGITS);
        let is_least = least.as_ref() == Some(&shown);
        if is_least { Cell::best(shown + "*") } else { Cell::plain(shown + " ") }
    });
    cells.collect()
}

/// A table with the labels of the rows at the left, as many columns side by side as the
/// terminal holds, the others below them under the same labels.
pub fn text_grid(corner: &str, labels: &[String], columns: &[GridColumn]) -> String {
    let width = |text: &str| text.chars().count();
    let first = labels.iter().map(|l| width(l)).chain([width(corner)]).max().unwrap_or(0);
    let widths: Vec<usize> = columns
        .iter()
        .map(|c| c.cells.iter().map(|cell| width(&cell.text)).fold(width(&c.header), usize::max))
        .collect();
    let mut out = String::new();
    for (start, end) in blocks(first, &widths) {
        if start > 0 {
            out.push('\n');
        }
        let mut header = format!("{FAINT}{corner:<first$}");
        for (column, width) in columns[start..end].iter().zip(&widths[start..end]) {
            header.push_str(&format!("  {:>width$}", column.header));
        }
        out.push_str(&format!("{}{FAINT:#}\n", header.trim_end()));
        for (row, label) in labels.iter().enumerate() {
            let mut line = format!("{label:<first$}");
            for (column, width) in columns[start..end].iter().zip(&widths[start..end]) {
                let Some(Cell { text, style }) = column.cells.get(row) else { continue };
                line.push_str(&format!("  {style}{text:>width$}{style:#}"));
            }
            out.push_str(&format!("{}\n", line.trim_end()));
        }
    }
    out
}

/// First and last but one column of every block that fits the terminal beside labels of width
/// `first`.
fn blocks(first: usize, widths: &[usize]) -> Vec<(usize, usize)> {
    let mut blocks: Vec<(usize, usize)> = Vec::new();
    let mut total = 0;
    for (index, width) in widths.iter().enumerate() {
        total += 2 + width;
        match blocks.last_mut() {
            Some((_, end)) if total <= TERMINAL_WIDTH => *end = index + 1,
            _ => {
                blocks.push((index, index + 1));
                total = first + 2 + width;
            }
        }
    }
    blocks
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_least_number_is_marked_as_it_is_shown() {
        let texts = |values: &[f64]| -> Vec<String> {
            mark_least(values).into_iter().map(|cell| cell.text).collect()
        };
        assert_eq!(texts(&[0.02, f64::NAN, 0.0200049, 1.0]), ["0.0200*", "- ", "0.0200*", "1.00 "]);
        assert_eq!(texts(&[f64::NAN]), ["- "]);
    }

    #[test]
    fn columns_that_do_not_fit_stand_below_under_the_same_labels() {
        let column = |name: &str| GridColumn {
            header: format!("{name:-<44}"),
            cells: vec![Cell::plain("1".into()), Cell::best("2".into())],
        };
        let labels = ["x".to_owned(), "y".to_owned()];
        let text = text_grid("", &labels, &[column("a"), column("b"), column("c")]);
        let plain = crate::text::terminal::without_escapes(&text);
        let lines: Vec<&str> = plain.lines().collect();
        assert_eq!(lines.len(), 7);
        assert!(lines[0].contains("a--") && lines[0].contains("b--") && !lines[0].contains("c--"));
        assert!(lines[3].is_empty() && lines[4].contains("c--") && lines[6].starts_with('y'));
        assert!(lines.iter().all(|line| line.chars().count() <= TERMINAL_WIDTH));
    }
}
