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

/// JSON that cannot end the script element that holds it.
pub fn escape_json(json: &str) -> String {
    json.replace('<', "\\u003c")
}
