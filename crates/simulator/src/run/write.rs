use std::collections::BTreeMap;
use std::io::{ErrorKind, Write};
use std::path::Path;

use logs::LogError;
use schemars::generate::SchemaSettings;
use schemars::{JsonSchema, Schema};
use serde::Serialize;

use crate::effects::truth::Truth;
use crate::error::SimulatorError;
use crate::run::simulate::Simulation;
use crate::scenario::check::Scenario;
use crate::strangers::truth::StrangerTruth;

/// File format of logs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LogFormat {
    /// Parquet with one `f64` column per signal.
    Parquet,
    /// Text with one row per line.
    Csv,
}

impl LogFormat {
    /// Extension of such files.
    pub const fn extension(self) -> &'static str {
        match self {
            Self::Parquet => "parquet",
            Self::Csv => "csv",
        }
    }
}

/// Writes the logs, the resolved scenario and `truth.json` into a folder.
///
/// Every file is written atomically. An old `truth.json` is removed first and the new one is written
/// last, so that a `truth.json` always belongs to the logs beside it.
///
/// # Errors
///
/// [`SimulatorError::Log`] when a file cannot be written.
pub fn write(
    folder: &Path,
    scenario: &Scenario,
    simulation: &Simulation,
    format: LogFormat,
) -> Result<(), SimulatorError> {
    let of_runs = simulation.truth_of_runs.iter();
    let content = TruthFile {
        seed: scenario.seed(),
        effects: Coded::all(&simulation.truth),
        runs: of_runs.map(|(run, truths)| (run.as_str(), Coded::all(truths))).collect(),
        strangers: &simulation.strangers,
    };
    let truth = serde_json::to_string_pretty(&content).unwrap_or_default() + "\n";
    let truth_file = folder.join("truth.json");
    match std::fs::remove_file(&truth_file) {
        Err(error) if error.kind() != ErrorKind::NotFound => {
            return Err(LogError::Unwritable { path: truth_file, reason: error.to_string() }.into());
        }
        _ => {}
    }
    for run in &simulation.runs {
        let path = folder.join(format!("{}.{}", run.name, format.extension()));
        match format {
            LogFormat::Parquet => logs::write_parquet(&path, run)?,
            LogFormat::Csv => logs::write_csv(&path, run)?,
        }
    }
    let scenario_file = folder.join("scenario.toml");
    for (path, text) in [(&scenario_file, scenario.self_contained_text()), (&truth_file, &truth)] {
        logs::replace_file(path, |file| Ok(file.write_all(text.as_bytes())?))?;
    }
    Ok(())
}

/// The JSON schema of `truth.json`.
pub fn truth_schema() -> Schema {
    let generator = SchemaSettings::draft2020_12().for_serialize().into_generator();
    let mut schema = generator.into_root_schema_for::<TruthFile<'static>>();
    schema.insert("title".to_owned(), "Plumbline truth".into());
    schema
}

/// What was put into the simulated arm.
#[derive(Serialize, JsonSchema)]
struct TruthFile<'a> {
    /// Seed of every random draw.
    seed: u64,
    /// The effects.
    effects: Vec<Coded<'a>>,
    /// By the name of a run, what it has beside these.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    runs: BTreeMap<&'a str, Vec<Coded<'a>>>,
    /// Effects of no catalogue.
    #[serde(skip_serializing_if = "<[_]>::is_empty")]
    strangers: &'a [StrangerTruth],
}

/// What was put in, and the code of its effect beside the name.
#[derive(Serialize, JsonSchema)]
struct Coded<'a> {
    /// Code of the effect, such as `FR01`.
    code: &'static str,
    #[serde(flatten)]
    truth: &'a Truth,
}

impl<'a> Coded<'a> {
    fn all(truths: &'a [Truth]) -> Vec<Self> {
        truths.iter().map(|truth| Self { code: truth.effect.code(), truth }).collect()
    }
}
