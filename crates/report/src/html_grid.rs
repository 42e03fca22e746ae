use askama::Template;

use crate::ReportError;
use crate::grid::Cell;

/// A table of a page: the first column says what a row is about, the others stand to the right.
#[derive(Template)]
#[template(path = "grid.html")]
pub struct Grid {
    /// What the first column is.
    pub corner: String,
    /// The names of the others.
    pub header: Vec<String>,
    /// The rows.
    pub rows: Vec<(String, Vec<Cell>)>,
}

/// A template as HTML.
///
/// # Errors
///
/// [`ReportError::Format`].
pub fn rendered(template: &impl Template) -> Result<String, ReportError> {
    template.render().map_err(|e| ReportError::Format { format: "HTML", reason: e.to_string() })
}
