use schemars::{Schema, json_schema, schema_for};
use simulator::scenario::ScenarioSpec;

use crate::error::CliError;

/// A schema as the text of a file.
///
/// # Errors
///
/// [`CliError::Output`].
pub fn schema_text(schema: &Schema) -> Result<String, CliError> {
    let text = serde_json::to_string_pretty(schema).map_err(std::io::Error::from)?;
    Ok(text + "\n")
}

/// The JSON schema of a scenario of `simulate` and `run`.
pub fn scenario_schema() -> Schema {
    with_extends(schema_for!(ScenarioSpec))
}

/// The schema of one file, which may extend others and leave to them what it needs.
pub fn with_extends(mut schema: Schema) -> Schema {
    schema.remove("required");
    let file = json_schema!({ "type": "string" });
    let extends = json_schema!({
        "description": "A file that this one extends, or several of which later ones count more, \
                        relative to this file. Tables are merged key by key, anything else is \
                        replaced, lists of tables as a whole.",
        "anyOf": [file, { "type": "array", "items": file }]
    });
    if let Some(properties) = schema.get_mut("properties").and_then(|p| p.as_object_mut()) {
        properties.insert("extends".to_owned(), extends.into());
    }
    schema
}
