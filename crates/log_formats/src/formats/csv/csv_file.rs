use std::{
    fs::File,
    io::{self, Read, Seek, SeekFrom, Take},
    path::{Path, PathBuf},
};

use crate::{
    common::{
        bounds::{BoundedLines, check_columns, too_many_rows},
        damage::Damage,
        dates::{TIME, date_ns},
        error::FormatError,
        sha256::sha256_of_files,
        table::{Needed, RowRefusal, Rows, Table, TableCell},
        unread_kinds::PROSE,
    },
    file_format::{FileFormat, Magic, Opened, Request},
    formats::csv::{
        dialect::{Dialect, Header, Numerals},
        listed_names::{ListedName, listed_names, with_names},
    },
};

/// Number of bytes from which the dialect is determined.
const PREVIEW: u64 = 1 << 18;
/// Number of bytes at the end of a file in which a torn row is searched.
const TAIL: u64 = 1 << 22;

/// The format of any text that is of no other kind.
pub(crate) struct Csv;

impl FileFormat for Csv {
    fn name(&self) -> &'static str {
        "CSV"
    }

    fn magic(&self) -> &'static [Magic] {
        &[]
    }

    fn open(
        &self,
        path: &Path,
        file: File,
        _: &Request,
        _: &mut Damage,
    ) -> Result<Box<dyn Opened>, FormatError> {
        Ok(Box::new(CsvFile::open(path, file)?))
    }
}

/// A log as text: rows of numbers, with or without a line of names above them.
pub(crate) struct CsvFile {
    path: PathBuf,
    file: File,
    dialect: Dialect,
    names: Vec<String>,
    /// Names that every row lists, and that entries are called by.
    listed: Vec<ListedName>,
    /// Start of a last row that was torn while it was written.
    torn_from: Option<u64>,
}

impl CsvFile {
    /// Determines the dialect, the names and whether the last row was torn.
    pub(crate) fn open(path: &Path, file: File) -> Result<Self, FormatError> {
        let told = |e: io::Error| FormatError::unreadable(path, &e);
        let mut preview = Vec::new();
        rewind_to(&file, 0)
            .and_then(|file| file.take(PREVIEW).read_to_end(&mut preview))
            .map_err(told)?;
        let dialect = Dialect::of(&preview);
        if dialect.header == Header::Names && dialect.has_no_row_in(&preview) {
            return Err(FormatError::other_kind(path, PROSE));
        }
        let torn_from = torn_from(&file).map_err(told)?;
        let path = path.to_owned();
        let (names, listed) = (Vec::new(), Vec::new());
        let mut csv = Self { path, file, dialect, names, listed, torn_from };
        (csv.names, csv.listed) = csv.first_names()?;
        Ok(csv)
    }

    /// The names of the columns, and those that the first row lists.
    fn first_names(&self) -> Result<(Vec<String>, Vec<ListedName>), FormatError> {
        let next = |records: &mut csv::Reader<_>| -> Result<Vec<String>, FormatError> {
            let mut record = csv::ByteRecord::new();
            let read = records.read_byte_record(&mut record);
            read.map_err(|e| FormatError::unreadable(&self.path, &e))?;
            check_columns(&self.path, record.len())?;
            let fields = self.dialect.fields(&record);
            Ok(fields.map(|f| String::from_utf8_lossy(f).into_owned()).collect())
        };
        // The start of the line shows too many names, before all of them are read.
        next(&mut self.records(PREVIEW)?)?;
        let mut records = self.records(u64::MAX)?;
        let mut first = next(&mut records)?;
        if self.dialect.header == Header::Numbers {
            return Ok(((1..=first.len()).map(|k| format!("column_{k}")).collect(), Vec::new()));
        }
        // A first row that cannot be read is told when all are read.
        let row = next(&mut records).unwrap_or_default();
        let begins_with_a_date = row.first().is_some_and(|field| date_ns(field).is_some());
        if begins_with_a_date && first[0].is_empty() && !first.iter().any(|name| name == TIME) {
            // The index of a table of pandas.
            TIME.clone_into(&mut first[0]);
        }
        let listed = listed_names(&first, &row);
        Ok((with_names(&first, &listed), listed))
    }

    /// The records in a number of bytes, from the line of names on.
    fn records(&self, bytes: u64) -> Result<csv::Reader<BoundedLines<Take<&File>>>, FormatError> {
        let start = self.dialect.start as u64;
        let end = self.torn_from.unwrap_or(u64::MAX).min(start.saturating_add(bytes));
        let text =
            rewind_to(&self.file, start).map_err(|e| FormatError::unreadable(&self.path, &e))?;
        Ok(self.dialect.records(BoundedLines::new(text.take(end.saturating_sub(start)))))
    }

    /// Checks the number of fields in a row. A row may end in one separator more than the line of names.
    fn check_length(&self, row: usize, record: &csv::ByteRecord) -> Result<(), FormatError> {
        let (found, expected) = (self.dialect.fields(record).count(), self.names.len());
        let ends_empty = self.dialect.fields(record).last().is_some_and(<[u8]>::is_empty);
        if found == expected || (found == expected + 1 && ends_empty) {
            return Ok(());
        }
        Err(FormatError::WrongFieldCount { path: self.path.clone(), row, found, expected })
    }

    /// Checks that a row lists the names that the first one lists.
    fn check_listed(&self, row: usize, record: &csv::ByteRecord) -> Result<(), FormatError> {
        for ListedName { column, name } in &self.listed {
            let found = self.dialect.fields(record).nth(*column).unwrap_or_default();
            if found != name.as_bytes() {
                let found = String::from_utf8_lossy(found).replace(char::is_control, " ");
                let reason = format!(
                    "row {row}, column {}: found {found:.40}, {name} was expected as in the first row",
                    self.names[*column]
                );
                return Err(FormatError::unreadable(&self.path, &reason));
            }
        }
        Ok(())
    }

    fn not_a_number(
        &self,
        row: usize,
        column: usize,
        record: &csv::ByteRecord,
        cells: &[TableCell],
    ) -> FormatError {
        let (path, name) = (self.path.clone(), self.names[column].clone());
        if cells[column] == TableCell::Empty {
            return FormatError::MissingValue { path, row, column: name };
        }
        let found = self.dialect.fields(record).nth(column).unwrap_or_default();
        // A message stays one line, whatever the file holds.
        let found = String::from_utf8_lossy(found).chars().take(40).collect();
        FormatError::NotANumber { path, row, column: name, found }
    }
}

impl Opened for CsvFile {
    /// Names in the order of the file; `column_1` and so on where the file has none.
    fn names(&self) -> Result<Vec<String>, FormatError> {
        Ok(self.names.clone())
    }

    /// Columns by name. In a needed column every field must be a number. Any other column is kept if every field is
    /// a number.
    fn load(&self, needed: &Needed, damage: &mut Damage) -> Result<Table, FormatError> {
        let mut rows = Rows::new(&self.names, needed);
        let mut numerals = vec![Numerals::between(self.dialect.separator); self.names.len()];
        let mut reader = self.records(u64::MAX)?;
        let mut record = csv::ByteRecord::new();
        let mut read = |record: &mut csv::ByteRecord| {
            reader.read_byte_record(record).map_err(|e| FormatError::unreadable(&self.path, &e))
        };
        if self.dialect.header == Header::Names {
            read(&mut record)?;
        }
        let mut row = 0;
        let mut cells = Vec::with_capacity(self.names.len());
        loop {
            match read(&mut record) {
                Ok(true) => row += 1,
                Ok(false) => break,
                Err(error) => {
                    damage.take(error)?;
                    break;
                }
            }
            if self.dialect.fields(&record).all(<[u8]>::is_empty) {
                continue;
            }
            cells.clear();
            let fields = self.dialect.fields(&record).zip(&mut numerals);
            cells.extend(fields.map(|(field, numerals)| numerals.cell(field)));
            let checked =
                self.check_length(row, &record).and_then(|()| self.check_listed(row, &record));
            let pushed = checked.and_then(|()| {
                let refused = |refusal| match refusal {
                    RowRefusal::NoNumber(column) => self.not_a_number(row, column, &record, &cells),
                    RowRefusal::TooMany => too_many_rows(&self.path, self.names.len()),
                };
                rows.push(row, &cells).map_err(refused)
            });
            if let Err(error) = pushed {
                damage.take(error)?;
                break;
            }
        }
        Ok(rows.finish())
    }

    fn sha256(&self) -> Result<String, FormatError> {
        sha256_of_files([self.path.as_path()])
    }

    fn is_unnamed(&self) -> bool {
        self.dialect.header == Header::Numbers
    }

    fn is_torn(&self) -> bool {
        self.torn_from.is_some()
    }
}

fn rewind_to(file: &File, start: u64) -> io::Result<&File> {
    let mut from = file;
    from.seek(SeekFrom::Start(start))?;
    Ok(file)
}

/// Start of a last row that was torn while it was written; `None` when the file is complete.
///
/// The crate `logs` ends every row that it writes during a run with a number in quotes. The last row is
/// torn when it has no newline, the line before it ends in such a number, and the last row does not.
fn torn_from(mut file: &File) -> io::Result<Option<u64>> {
    let length = file.seek(SeekFrom::End(0))?;
    let start = length.saturating_sub(TAIL);
    let last_byte = length.saturating_sub(1);
    let mut tail = Vec::new();
    rewind_to(file, last_byte)?.read_to_end(&mut tail)?;
    if tail == b"\n" || tail.is_empty() {
        return Ok(None);
    }
    tail.clear();
    rewind_to(file, start)?.read_to_end(&mut tail)?;
    let mut lines = tail.rsplitn(3, |&byte| byte == b'\n');
    let (last, before) = (lines.next().unwrap_or_default(), lines.next().unwrap_or_default());
    let is_torn = ends_in_quoted_number(before) && !ends_in_quoted_number(last);
    Ok(is_torn.then(|| length - last.len() as u64))
}

fn ends_in_quoted_number(line: &[u8]) -> bool {
    let field = line.trim_ascii_end().strip_suffix(b"\"").and_then(|line| {
        let start = line.iter().rposition(|&byte| byte == b'"')?;
        std::str::from_utf8(&line[start + 1..]).ok()
    });
    field.is_some_and(|field| field.parse::<f64>().is_ok())
}
