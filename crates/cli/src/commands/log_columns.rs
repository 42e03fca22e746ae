//! A log whose columns name no joint: what its columns are.

use logs::{ColumnOverview, FileOverview, FormatError, LogError};
use report::significant;
use schemars::JsonSchema;
use serde::Serialize;

use crate::error::CliError;
use crate::output::table;

/// Whether a file was refused for what its columns are called.
pub fn is_about_names(error: &CliError) -> bool {
    matches!(
        error,
        CliError::NoJoints { .. }
            | CliError::Log(
                LogError::JointAbsent { .. }
                    | LogError::EffortAbsent { .. }
                    | LogError::NoNames { .. }
                    | LogError::File(FormatError::NoColumn { .. })
            )
    )
}

/// The columns of a file as a table, with what reads them.
pub fn text(path: &str, overview: &FileOverview) -> String {
    let FileOverview { rows, columns, .. } = overview;
    let header = ["column", "values", "remarks"];
    // The first column that rises is that of time.
    let time = columns.iter().position(|column| column.rises_by.is_some());
    let rows_of_table = columns.iter().enumerate().map(|(k, column)| {
        let range = |(low, high)| format!("{} to {}", significant(low, 6), significant(high, 6));
        let rises = |step| format!("rises by {} a row", significant(step, 3));
        let remarks = match (column.range, column.rises_by.filter(|_| time == Some(k))) {
            (None, _) => "no column of numbers".to_owned(),
            (_, rises_by) => rises_by.map(rises).unwrap_or_default(),
        };
        vec![column.name.clone(), column.range.map_or("-".to_owned(), range), remarks]
    });
    let table = table(&header, rows_of_table);
    format!("{path}\n {rows} rows, {} columns\n{table} {}\n", columns.len(), advice(overview))
}

/// How to read such a file.
fn advice(FileOverview { fitting, .. }: &FileOverview) -> String {
    match fitting {
        Some(own) => {
            let map = if own.is_certain { String::new() } else { format!("--map {} ", own.name) };
            let joints = if own.count == 1 { "joint" } else { "joints" };
            format!(
                "These are the columns of --map {} ({}), of {} {joints}: {map}--robot FILE reads them.",
                own.name, own.words, own.count
            )
        }
        None => "No joint is named <joint>.position, and no preset fits: a column map says which column is \
                 what, such as\n   time = \"t\"\n   position = \"q{n}\"   # {n} counts from 1, {i} from 0, \
                 {joint} is the name\n   effort = \"tau{n}\"\n and --map FILE --robot FILE reads the log with it."
            .to_owned(),
    }
}

/// A file by its columns, as `--json` prints it.
#[derive(Serialize, JsonSchema)]
pub struct ColumnsRecord {
    path: String,
    rows: usize,
    columns: Vec<ColumnRecord>,
    /// The preset column map that fits.
    map: Option<&'static str>,
    /// Number of joints that it finds.
    joints: Option<usize>,
}

#[derive(Serialize, JsonSchema)]
struct ColumnRecord {
    name: String,
    range: Option<(f64, f64)>,
    rises_by: Option<f64>,
}

impl ColumnsRecord {
    /// The record of a file.
    pub fn new(path: &str, overview: &FileOverview) -> Self {
        let record = |column: &ColumnOverview| ColumnRecord {
            name: column.name.clone(),
            range: column.range,
            rises_by: column.rises_by,
        };
        Self {
            path: path.to_owned(),
            rows: overview.rows,
            columns: overview.columns.iter().map(record).collect(),
            map: overview.fitting.as_ref().map(|own| own.name),
            joints: overview.fitting.as_ref().map(|own| own.count),
        }
    }
}
