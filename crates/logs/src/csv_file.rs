use std::{
    collections::{BTreeMap, BTreeSet},
    fs::{self, File},
    io::{self, Read, Seek, SeekFrom},
    path::Path,
};

use crate::LogError;

fn reader(path: &Path) -> Result<csv::Reader<io::Take<File>>, LogError> {
    let end = torn_from(path)?.unwrap_or(u64::MAX);
    let file = File::open(path).map_err(|e| unreadable(path, &e))?.take(end);
    // Rows of another length are let through here and refused by `load` with their number.
    Ok(csv::ReaderBuilder::new().flexible(true).trim(csv::Trim::All).from_reader(file))
}

/// Where a last row begins that was torn while it was written; none when the file is whole.
///
/// A row without its newline is torn when the line before it ends in a number in quotes, as
/// every row of a [`crate::LogWriter`] does, and it does not.
pub(crate) fn torn_from(path: &Path) -> Result<Option<u64>, LogError> {
    let ends_well = || -> io::Result<bool> {
        let mut file = File::open(path)?;
        let mut last = [b'\n'];
        if file.seek(SeekFrom::End(0))? > 0 {
            file.seek(SeekFrom::End(-1))?;
            file.read_exact(&mut last)?;
        }
        Ok(last == [b'\n'])
    };
    if ends_well().map_err(|e| unreadable(path, &e))? {
        return Ok(None);
    }
    let bytes = fs::read(path).map_err(|e| unreadable(path, &e))?;
    let mut lines = bytes.rsplitn(3, |&byte| byte == b'\n');
    let (last, before) = (lines.next().unwrap_or_default(), lines.next().unwrap_or_default());
    let is_torn = ends_in_quoted_number(before) && !ends_in_quoted_number(last);
    Ok(is_torn.then(|| (bytes.len() - last.len()) as u64))
}

fn ends_in_quoted_number(line: &[u8]) -> bool {
    let field = line.trim_ascii_end().strip_suffix(b"\"").and_then(|line| {
        let start = line.iter().rposition(|&byte| byte == b'"')?;
        std::str::from_utf8(&line[start + 1..]).ok()
    });
    field.is_some_and(|field| field.parse::<f64>().is_ok())
}

fn unreadable(path: &Path, error: &impl ToString) -> LogError {
    LogError::Unreadable { path: path.to_owned(), reason: error.to_string() }
}

/// Names of the columns, in the order of the file.
pub(crate) fn names(path: &Path) -> Result<Vec<String>, LogError> {
    let mut reader = reader(path)?;
    let header = reader.headers().map_err(|e| unreadable(path, &e))?;
    Ok(header.iter().map(|n| n.trim_start_matches('\u{feff}').to_owned()).collect())
}

/// Columns by name: those in `required`, where every field must be a number, and of the
/// rest those in which every field is one.
pub(crate) fn load(
    path: &Path,
    required: &BTreeSet<&str>,
) -> Result<BTreeMap<String, Vec<f64>>, LogError> {
    let names = names(path)?;
    let mut columns: Vec<Option<Vec<f64>>> = vec![Some(Vec::new()); names.len()];
    let mut reader = reader(path)?;
    let mut record = csv::StringRecord::new();
    let mut row = 0;
    while reader.read_record(&mut record).map_err(|e| unreadable(path, &e))? {
        row += 1;
        if record.len() != names.len() {
            let (found, expected) = (record.len(), names.len());
            return Err(LogError::WrongFieldCount { path: path.to_owned(), row, found, expected });
        }
        for ((field, name), column) in record.iter().zip(&names).zip(&mut columns) {
            let Some(samples) = column else { continue };
            match field.parse() {
                Ok(value) => samples.push(value),
                Err(_) if required.contains(name.as_str()) => {
                    return Err(not_a_number(path, row, name, field));
                }
                Err(_) => *column = None,
            }
        }
    }
    let named = names.into_iter().zip(columns);
    Ok(named.filter_map(|(name, column)| Some((name, column?))).collect())
}

fn not_a_number(path: &Path, row: usize, column: &str, found: &str) -> LogError {
    let (path, column) = (path.to_owned(), column.to_owned());
    if found.is_empty() {
        return LogError::MissingValue { path, row, column };
    }
    // A message stays one line, whatever the file holds.
    let found = found.chars().take(40).collect();
    LogError::NotANumber { path, row, column, found }
}
