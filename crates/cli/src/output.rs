use std::io::{ErrorKind, Write};
use std::path::Path;

use comfy_table::presets::NOTHING;
use comfy_table::{CellAlignment, ContentArrangement, Table};
use report::ReportError;
use serde::Serialize;

use crate::error::CliError;
use crate::escape::{escape, escape_json};
use crate::messages::tell;
use crate::quiet::Quiet;

/// Prints text on the standard output, its colours only where they are wanted and nothing else that a terminal obeys.
///
/// A reader that has gone has read what it wanted: that is no error.
///
/// # Errors
///
/// [`CliError::Output`].
pub fn print(text: &str) -> Result<(), CliError> {
    let mut out = anstream::stdout().lock();
    match out.write_all(escape(text).as_bytes()).and_then(|()| out.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => Err(error.into()),
        _ => Ok(()),
    }
}

/// Prints a value as JSON on the standard output.
///
/// # Errors
///
/// [`CliError::Output`].
pub fn print_json(value: &impl Serialize) -> Result<(), CliError> {
    let text = serde_json::to_string_pretty(value).map_err(std::io::Error::from)?;
    print(&escape_json(&(text + "\n")))
}

/// Prints the answer of a command: its text and where the files lie, or its JSON. With JSON, where
/// the files lie goes to the standard error. A quiet command prints the JSON alone.
///
/// # Errors
///
/// [`CliError::Output`].
pub fn print_answer(
    Quiet(quiet): Quiet,
    json: Option<&str>,
    text: impl FnOnce() -> String,
    closing: &str,
) -> Result<(), CliError> {
    json.map_or(Ok(()), |json| print(&escape_json(json)))?;
    match (quiet, json) {
        (true, _) => {}
        (false, Some(_)) => tell(&closing.trim_end()),
        (false, None) => print(&format!("{}\n{closing}", text()))?,
    }
    Ok(())
}

/// A table without lines, numbers to the right, for a terminal of any width.
///
/// Columns whose header starts with `>` are aligned to the right.
pub fn table(header: &[&str], rows: impl IntoIterator<Item = Vec<String>>) -> String {
    let mut table = Table::new();
    table.load_style(NOTHING).set_content_arrangement(ContentArrangement::Disabled);
    table.set_header(header.iter().map(|name| name.trim_start_matches('>')));
    for (index, _) in header.iter().enumerate().filter(|(_, name)| name.starts_with('>')) {
        if let Some(column) = table.column_mut(index) {
            column.set_cell_alignment(CellAlignment::Right);
        }
    }
    rows.into_iter().for_each(|row| {
        table.add_row(row);
    });
    let lines = table.lines().map(|line| format!(" {}\n", line.trim_end()));
    lines.collect()
}

/// The file as it was given, for messages and provenance.
pub fn display_path(path: &Path) -> String {
    path.display().to_string()
}

/// Refuses an output folder that is a file.
///
/// # Errors
///
/// [`ReportError::NotAFolder`].
pub fn refuse_file(folder: &Path) -> Result<(), ReportError> {
    if folder.exists() && !folder.is_dir() {
        return Err(ReportError::NotAFolder { path: folder.to_owned() });
    }
    Ok(())
}

/// The output folder, made before the work so that none is lost.
///
/// # Errors
///
/// [`CliError::Folder`].
pub fn create_folder(folder: &Path) -> Result<(), CliError> {
    std::fs::create_dir_all(folder).map_err(|error| {
        let reason = if folder.is_file() { "it is a file".to_owned() } else { error.to_string() };
        CliError::Folder { path: folder.to_owned(), reason }
    })
}

/// Refuses to write files of an output folder over files that are read.
///
/// # Errors
///
/// [`CliError::OwnInput`].
pub fn keep_inputs<'a>(
    out: &Path,
    names: &[&str],
    inputs: impl IntoIterator<Item = &'a Path>,
) -> Result<(), CliError> {
    let written: Vec<_> =
        names.iter().filter_map(|name| out.join(name).canonicalize().ok()).collect();
    for input in inputs {
        if input.canonicalize().is_ok_and(|input| written.contains(&input)) {
            return Err(CliError::OwnInput { path: input.to_owned() });
        }
    }
    Ok(())
}
