use askama::Template;

use crate::tables::grid::Cell;

/// A table of a page: the first column says what a row is about, the others stand to the right.
#[derive(Template)]
#[template(path = "grid.html")]
pub struct HtmlGrid {
    /// What the first column is.
    pub corner: String,
    /// The names of the others.
    pub header: Vec<String>,
    /// The rows.
    pub rows: Vec<(String, Vec<Cell>)>,
}
