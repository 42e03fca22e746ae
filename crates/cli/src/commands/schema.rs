mod page;

use clap::ValueEnum;
use experiment::TrackingSpec;
use logs::ColumnMap;
use report::{LearningComparison, ReplayReport, RunReport, TrackingComparison};
use schemars::{JsonSchema, Schema, schema_for};
use serde::Serialize;

use crate::commands::design::motion_design::DesignSummary;
use crate::commands::{explain, export, log_info, robot_check, robot_init, simulate};
use crate::error::CliError;
use crate::exit_status::ExitStatus;
use crate::output::{print, print_json, table};
use crate::schema_text::{scenario_schema, schema_text, with_extends};

/// Name and version of the schema of the list that `--json` prints.
const SCHEMA: &str = "plumbline.schemas/1";

/// Arguments of `schema`.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// Of which file; without it all are listed
    #[arg(value_enum, hide_possible_values = true)]
    name: Option<FileKind>,
    /// Print a page in Markdown: every key with its unit, its default and what it means
    #[arg(long, requires = "name")]
    markdown: bool,
    /// Print the list of all as JSON
    #[arg(long, conflicts_with = "name")]
    json: bool,
}

/// A kind of file, or of what `--json` prints.
#[derive(Debug, Clone, Copy, ValueEnum)]
pub enum FileKind {
    /// robot.toml and extended.toml: what a URDF cannot say
    Robot,
    /// Column maps, for --map
    Map,
    /// scenario.toml: runs of a simulated arm
    #[value(alias = "simulate")]
    Scenario,
    /// Scenarios of track: a motion tracked with models
    #[value(alias = "track")]
    TrackingScenario,
    /// diagnosis.json
    Diagnosis,
    /// comparison.json of compare
    Comparison,
    /// design --json
    Design,
    /// metrics.json of run
    Run,
    /// simulate --json
    Simulation,
    /// What simulate has put in, which it writes apart from the logs
    Truth,
    /// replay.json
    Replay,
    /// learning.json
    Learning,
    /// tracking.json
    Tracking,
    /// export --json
    Export,
    /// robot check --json
    RobotCheck,
    /// robot init --json
    RobotInit,
    /// log info --json
    LogInfo,
    /// explain --json
    Effects,
    /// explain EFFECT --json
    Effect,
    /// schema --json
    Schemas,
}

impl FileKind {
    /// The JSON schema of the file.
    pub fn schema(self) -> Schema {
        match self {
            Self::Robot => robot::description_schema(),
            Self::Map => ColumnMap::schema(),
            Self::Scenario => scenario_schema(),
            Self::TrackingScenario => with_extends(schema_for!(TrackingSpec)),
            Self::Diagnosis => report::diagnosis_schema(),
            Self::Comparison => report::change_schema(),
            Self::Design => DesignSummary::schema(),
            Self::Run => RunReport::schema(),
            Self::Simulation => simulate::schema(),
            Self::Truth => simulator::truth_schema(),
            Self::Replay => ReplayReport::schema(),
            Self::Learning => LearningComparison::schema(),
            Self::Tracking => TrackingComparison::schema(),
            Self::Export => export::schema(),
            Self::RobotCheck => robot_check::schema(),
            Self::RobotInit => robot_init::schema(),
            Self::LogInfo => log_info::schema(),
            Self::Effects => explain::schema(),
            Self::Effect => explain::schema_of_one(),
            Self::Schemas => report::written_schema::<Schemas>(SCHEMA, "Plumbline schemas"),
        }
    }

    /// What stands below the keys on the page of the file.
    fn more(self) -> String {
        match self {
            Self::Map => format!(
                "\n## Maps with a name\n\nA file without the usual names that has all columns of one of these maps is read so, and the \
                 program says it; PlotJuggler's columns may be under any topic. `plumbline log info FILE` tells which map a file fits.\n\n{}",
                logs::preset_table()
            ),
            _ => String::new(),
        }
    }

    /// The schema as the text of a file.
    ///
    /// # Errors
    ///
    /// [`CliError::Output`].
    pub fn text(self) -> Result<String, CliError> {
        schema_text(&self.schema())
    }
}

/// Prints the JSON schema of a file, which editors complete and check keys with, or the list of all.
pub fn run(arguments: &Arguments) -> Result<ExitStatus, CliError> {
    match arguments.name {
        Some(kind) if arguments.markdown => print(&(page::page(&kind.schema()) + &kind.more()))?,
        Some(kind) => print(&kind.text()?)?,
        None if arguments.json => print_json(&Schemas { schema: SCHEMA, schemas: entries() })?,
        None => print(&list())?,
    }
    Ok(ExitStatus::Good)
}

/// What `--json` prints of all schemas.
#[derive(Serialize, JsonSchema)]
struct Schemas {
    schema: &'static str,
    schemas: Vec<SchemaEntry>,
}

/// A schema of the list.
#[derive(Serialize, JsonSchema)]
struct SchemaEntry {
    /// Its name, such as `robot`.
    name: String,
    /// What it is the schema of.
    of: String,
}

/// All schemas.
fn entries() -> Vec<SchemaEntry> {
    let values = FileKind::value_variants().iter().filter_map(FileKind::to_possible_value);
    let entry = |value: clap::builder::PossibleValue| SchemaEntry {
        name: value.get_name().to_owned(),
        of: value.get_help().map(ToString::to_string).unwrap_or_default(),
    };
    values.map(entry).collect()
}

/// The names of all schemas.
fn list() -> String {
    let rows = entries().into_iter().map(|entry| vec![entry.name, entry.of]);
    format!(
        "{}\nplumbline schema NAME prints one. In TOML, a first line `#:schema ./FILE` tells editors where it is.\n",
        table(&["schema", "of"], rows)
    )
}

/// Prints the schema of one file, which may extend others and leave to them what it needs.
///
/// # Errors
///
/// [`CliError::Output`].
pub fn print_schema(schema: Schema) -> Result<(), CliError> {
    print_json(&with_extends(schema))
}
