use serde::Serialize;

use crate::output::error::ReportError;

/// A value as JSON on lines, the last one ended.
pub fn to_json(value: &impl Serialize) -> Result<String, ReportError> {
    let mut text = serde_json::to_string_pretty(value)
        .map_err(|e| ReportError::Format { format: "JSON", reason: e.to_string() })?;
    text.push('\n');
    Ok(text)
}

/// A value as JSON, with the name of its schema at the top.
pub fn with_schema(schema: &str, value: &impl Serialize) -> Result<String, ReportError> {
    #[derive(Serialize)]
    struct Named<'a, T> {
        schema: &'a str,
        #[serde(flatten)]
        value: &'a T,
    }
    to_json(&Named { schema, value })
}
