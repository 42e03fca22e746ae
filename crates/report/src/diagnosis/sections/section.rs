use askama::Template;
use pages::{ReportError, render_html};

use crate::diagnosis::report::Report;

/// A section of the page: its context, which its template shows.
pub(crate) trait Section<'a>: Template + Sized {
    /// The context; none where the report has nothing to show there.
    ///
    /// # Errors
    ///
    /// [`ReportError::Format`] where a figure cannot be drawn.
    fn new(report: &Report<'a>) -> Result<Option<Self>, ReportError>;
}

/// Draws a section of a report; an empty text where the section has nothing to show.
pub(crate) type Draw = fn(&Report) -> Result<String, ReportError>;

/// A section as HTML.
///
/// # Errors
///
/// [`ReportError::Format`].
pub(crate) fn draw<'a, S: Section<'a>>(report: &Report<'a>) -> Result<String, ReportError> {
    S::new(report)?.map_or_else(|| Ok(String::new()), |section| render_html(&section))
}

/// Those of some sections that have something to show, as HTML.
///
/// # Errors
///
/// [`ReportError::Format`].
pub(crate) fn draw_all(sections: &[Draw], report: &Report) -> Result<Vec<String>, ReportError> {
    let mut drawn = Vec::new();
    for draw in sections {
        drawn.push(draw(report)?);
    }
    drawn.retain(|section| !section.is_empty());
    Ok(drawn)
}
