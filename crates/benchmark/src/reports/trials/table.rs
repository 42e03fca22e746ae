use pages::{Cell, HtmlGrid, ReportError, render_html};

use crate::statistics::text_table::TextTable;

/// A text table for a page, without the title, which the page shows.
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
    render_html(&HtmlGrid {
        corner: header.next().unwrap_or_default(),
        header: header.collect(),
        rows: table.rows.into_iter().map(row).collect(),
    })
}
