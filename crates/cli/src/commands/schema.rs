use clap::ValueEnum;
use evaluation::{CampaignSpec, FigureScenario, PopulationCampaign, TrackingSpec};
use schemars::{Schema, json_schema, schema_for};
use serde_json::{Value, json};
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
    /// A campaign of blind trials
    Trials,
    /// A figure of the paper
    Figure,
}

/// Prints the JSON schema of scenario files, which editors complete and check keys with.
///
/// It is that of one file, which may extend others and leave to them what a scenario needs.
pub fn run(arguments: &Arguments) -> Result<ExitStatus, CliError> {
    let mut schema = match arguments.command {
        Kind::Simulate => schema_for!(ScenarioSpec),
        Kind::Track => schema_for!(TrackingSpec),
        Kind::Trials => campaigns(),
        Kind::Figure => schema_for!(FigureScenario),
    };
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
    print_json(&schema)?;
    Ok(ExitStatus::Good)
}

/// A campaign of either form: its keys are those of both, and a population leaves out the others.
fn campaigns() -> Schema {
    let mut schema = schema_for!(CampaignSpec);
    let mut population = schema_for!(PopulationCampaign);
    for name in ["properties", "$defs"] {
        let Some(more) = population.get_mut(name).and_then(|more| more.as_object_mut()) else {
            continue;
        };
        let more = std::mem::take(more);
        let own = schema.ensure_object().entry(name).or_insert_with(|| json!({}));
        if let Some(own) = own.as_object_mut() {
            own.extend(more);
        }
    }
    let others: Vec<Value> = ["scenario", "hidden", "except", "seeds", "seed", "settings", "gains"]
        .iter()
        .map(|name| json!({ "required": [name] }))
        .collect();
    schema.insert("not".to_owned(), json!({ "required": ["population"], "anyOf": others }));
    schema
}
