use benchmark::TextTable;

use crate::ReportError;
use crate::grid::Cell;
use crate::html_grid::{Grid, rendered};

/// A table of texts for a page; the page tells its title.
///
/// # Errors
///
/// [`ReportError::Format`].
pub fn table(table: TextTable) -> Result<String, ReportError> {
    let mut header = table.header.into_iter();
    let row = |row: Vec<String>| {
        let mut cells = row.into_iter();
        (cells.next().unwrap_or_default(), cells.map(Cell::plain).collect())
    };
    rendered(&Grid {
        corner: header.next().unwrap_or_default(),
        header: header.collect(),
        rows: table.rows.into_iter().map(row).collect(),
    })
}
