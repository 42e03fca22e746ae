use benchmark::{BenchManifest, CampaignSpec, FigureScenario, PopulationCampaign, TrialAnswer};
use clap::ValueEnum;
use cli::{print_json, print_schema};
use schemars::{Schema, schema_for};
use serde_json::{Value, json};

use crate::error::BenchError;
use crate::exit_status::BenchExitStatus;

/// Arguments of `schema`.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// Of which files
    #[arg(value_enum, default_value_t = Kind::Campaign)]
    kind: Kind,
}

/// What a file describes.
#[derive(Debug, Clone, Copy, ValueEnum)]
enum Kind {
    /// A campaign of blind trials
    Campaign,
    /// A figure of the paper
    Figure,
    /// The answer to a trial of CauseBench
    Answers,
    /// The manifest of a set of CauseBench
    Manifest,
}

/// Prints the JSON schema of a kind of file, which editors complete and check keys with.
pub fn run(arguments: &Arguments) -> Result<BenchExitStatus, BenchError> {
    match arguments.kind {
        Kind::Campaign => print_schema(campaigns())?,
        Kind::Figure => print_schema(schema_for!(FigureScenario))?,
        Kind::Answers => print_json(&schema_for!(TrialAnswer))?,
        Kind::Manifest => print_json(&schema_for!(BenchManifest))?,
    }
    Ok(BenchExitStatus::Good)
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
