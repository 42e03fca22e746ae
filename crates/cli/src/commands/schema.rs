use clap::ValueEnum;
use experiment::TrackingSpec;
use schemars::{Schema, json_schema, schema_for};
use simulator::scenario::ScenarioSpec;

use crate::error::CliError;
use crate::exit_status::ExitStatus;
use crate::output::print_json;

/// Arguments of `schema`.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// Of which command's scenarios
    #[arg(value_enum, default_value_t = Kind::Simulate)]
    command: Kind,
}

/// What a scenario is for.
#[derive(Debug, Clone, Copy, ValueEnum)]
enum Kind {
    /// Runs of a simulated arm
    Simulate,
    /// A motion tracked with models
    Track,
}

/// Prints the JSON schema of scenario files, which editors complete and check keys with.
///
/// It is that of one file, which may extend others and leave to them what a scenario needs.
pub fn run(arguments: &Arguments) -> Result<ExitStatus, CliError> {
    print_schema(match arguments.command {
        Kind::Simulate => schema_for!(ScenarioSpec),
        Kind::Track => schema_for!(TrackingSpec),
    })?;
    Ok(ExitStatus::Good)
}

/// Prints the schema of one file, which may extend others and leave to them what it needs.
///
/// # Errors
///
/// [`CliError::Output`].
pub fn print_schema(mut schema: Schema) -> Result<(), CliError> {
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
    print_json(&schema)
}
