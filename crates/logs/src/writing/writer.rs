use std::{
    fs::File,
    io::{Seek, SeekFrom, Write},
    path::{Path, PathBuf},
};

use log_formats::FormatError;

use crate::{error::LogError, runs::run::Channel, writing::write::column_name};

/// Time of the log between two writes to the file (s).
const BLOCK_S: f64 = 1.0;

/// A CSV log that is written while it is recorded, about once per second of its own time.
///
/// ```text
/// time,j1.position,j1.effort,"gauge"
/// 0,0.5,1.25,"0"
/// 0.002,0.5000012,1.25,"0.125"
/// ```
///
/// Rows are written in whole blocks. The last field of every row is in quotes, which
/// any CSV reader removes. [`crate::read_run`] can read the log of a program that was killed: a
/// last row without its closing quote was torn and is left out, so that half a number
/// is never taken for a whole one. Reading returns exactly the same numbers.
///
/// Collected rows are also written when the writer goes out of scope. An error is lost there;
/// [`LogWriter::finish`] returns it.
#[derive(Debug)]
pub struct LogWriter {
    path: PathBuf,
    file: File,
    /// Number of fields in a row.
    fields: usize,
    /// Number of rows received.
    rows: usize,
    /// Number of bytes of the file that are known to be complete.
    written: u64,
    /// Rows that are collected and not yet written.
    block: Vec<u8>,
    /// Time of the first collected row (s).
    block_start: Option<f64>,
}

impl LogWriter {
    /// Creates a file with the columns `time`, `<joint>.<channel>` and the further ones. The
    /// order is that of [`crate::write_csv`]: all joints of one channel, then those of the next. An earlier
    /// file of that name is overwritten.
    ///
    /// # Errors
    ///
    /// [`LogError::Unwritable`].
    pub fn create(
        path: &Path,
        joints: &[&str],
        channels: &[Channel],
        further: &[&str],
    ) -> Result<Self, LogError> {
        let mut names = vec!["time".to_owned()];
        names.extend(channels.iter().flat_map(|&c| joints.iter().map(move |j| column_name(j, c))));
        names.extend(further.iter().map(|&name| name.to_owned()));
        let unwritable = |reason: String| LogError::Unwritable { path: path.to_owned(), reason };
        let header = header(&names).map_err(|e| unwritable(e.to_string()))?;
        let mut writer = Self {
            path: path.to_owned(),
            file: File::create(path).map_err(|e| unwritable(e.to_string()))?,
            fields: names.len(),
            rows: 0,
            written: 0,
            block: header,
            block_start: None,
        };
        writer.flush()?;
        Ok(writer)
    }

    /// Adds a row: the time (s), then a number for every other column.
    ///
    /// # Errors
    ///
    /// - [`FormatError::WrongFieldCount`] for too few or too many numbers. The row is
    ///   left out.
    /// - [`LogError::Unwritable`] when a block cannot be written. The block is kept, and is
    ///   written again with the next row.
    pub fn row(&mut self, values: &[f64]) -> Result<(), LogError> {
        let (Some(time), Some((last, others))) = (values.first(), values.split_last()) else {
            return Err(self.wrong_length(0));
        };
        if values.len() != self.fields {
            return Err(self.wrong_length(values.len()));
        }
        for value in others {
            self.push(format_args!("{value},"))?;
        }
        self.push(format_args!("\"{last}\"\n"))?;
        self.rows += 1;
        let start = *self.block_start.get_or_insert(*time);
        // A clock that went back, or is none, does not keep rows from the file.
        if (0.0..BLOCK_S).contains(&(time - start)) { Ok(()) } else { self.flush() }
    }

    /// Writes the rows that are still collected.
    ///
    /// # Errors
    ///
    /// [`LogError::Unwritable`].
    pub fn finish(mut self) -> Result<(), LogError> {
        self.flush()?;
        self.file.sync_all().map_err(|e| self.unwritable(&e))
    }

    fn push(&mut self, text: std::fmt::Arguments) -> Result<(), LogError> {
        self.block.write_fmt(text).map_err(|e| self.unwritable(&e))
    }

    fn flush(&mut self) -> Result<(), LogError> {
        if let Err(error) = self.file.write_all(&self.block) {
            // Half a block would tear a row in the middle of the file. The error that is told
            // is the first one.
            let _ = self.file.set_len(self.written);
            let _ = self.file.seek(SeekFrom::Start(self.written));
            return Err(self.unwritable(&error));
        }
        self.written += self.block.len() as u64;
        self.block.clear();
        self.block_start = None;
        Ok(())
    }

    fn unwritable(&self, error: &std::io::Error) -> LogError {
        LogError::Unwritable { path: self.path.clone(), reason: error.to_string() }
    }

    fn wrong_length(&self, found: usize) -> LogError {
        let (path, row, expected) = (self.path.clone(), self.rows + 1, self.fields);
        FormatError::WrongFieldCount { path, row, found, expected }.into()
    }
}

impl Drop for LogWriter {
    fn drop(&mut self) {
        // Nobody is left to receive the error.
        let _ = self.flush();
    }
}

/// The names as a row of CSV, the last one in quotes.
fn header(names: &[String]) -> Result<Vec<u8>, csv::Error> {
    let Some((last, others)) = names.split_last() else { return Ok(Vec::new()) };
    let mut row = Vec::new();
    if !others.is_empty() {
        let mut writer = csv::Writer::from_writer(&mut row);
        writer.write_record(others)?;
        writer.flush()?;
        drop(writer);
        row.pop();
        row.push(b',');
    }
    row.extend(format!("\"{}\"\n", last.replace('"', "\"\"")).bytes());
    Ok(row)
}
