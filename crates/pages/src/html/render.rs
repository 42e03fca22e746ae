use askama::Template;

use crate::output::error::ReportError;

/// A template as HTML.
///
/// # Errors
///
/// [`ReportError::Format`].
pub fn render_html(template: &impl Template) -> Result<String, ReportError> {
    template.render().map_err(|e| ReportError::Format { format: "HTML", reason: e.to_string() })
}

/// JSON for a script element: no text in it can end the element.
pub fn escape_json(json: &str) -> String {
    json.replace('<', "\\u003c")
}
