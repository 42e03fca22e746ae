//! Bounds of a table, the same in every format.

use std::{
    io::{self, Read},
    path::Path,
};

use crate::common::error::FormatError;

/// Most columns of a table.
pub(crate) const MOST_COLUMNS: usize = 10_000;
/// Most entries of a list that a file keeps beside its numbers: topics, groups, arrays.
pub(crate) const MOST_ENTRIES: usize = 10_000;
/// Longest line of a text, the line of names included (bytes).
const LONGEST_LINE: u64 = 1 << 24;

/// Most rows and numbers of a table.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct TableSize {
    pub rows: u64,
    pub cells: u64,
}

/// 28 hours at 1 kHz, and 8 GB of numbers.
pub(crate) const MOST: TableSize = TableSize { rows: 100_000_000, cells: 1_000_000_000 };

impl TableSize {
    /// Whether a table of so many rows and columns is within these bounds.
    pub(crate) fn holds(self, rows: u64, columns: usize) -> bool {
        rows <= self.rows && rows.saturating_mul(columns as u64) <= self.cells
    }
}

/// Refuses a table with more rows or numbers than are read.
pub(crate) fn check_size(path: &Path, rows: u64, columns: usize) -> Result<(), FormatError> {
    if MOST.holds(rows, columns) { Ok(()) } else { Err(too_many_rows(path, columns)) }
}

/// The refusal of a table that has more rows than are read of so many columns.
pub(crate) fn too_many_rows(path: &Path, columns: usize) -> FormatError {
    let most = MOST.rows.min(MOST.cells / columns.max(1) as u64);
    FormatError::TooManyRows { path: path.to_owned(), columns, most }
}

/// Refuses a table with more columns than are read. `found` may be a part of them.
pub(crate) fn check_columns(path: &Path, found: usize) -> Result<(), FormatError> {
    match found {
        0..=MOST_COLUMNS => Ok(()),
        _ => Err(FormatError::TooManyColumns { path: path.to_owned(), most: MOST_COLUMNS }),
    }
}

/// A text whose lines have a bounded length.
pub(crate) struct BoundedLines<R> {
    source: R,
    /// Bytes since the last end of a line.
    line: u64,
}

impl<R> BoundedLines<R> {
    pub(crate) fn new(source: R) -> Self {
        Self { source, line: 0 }
    }
}

impl<R: Read> Read for BoundedLines<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        // The decoder of CSV does not ask again where a signal interrupts.
        let count = files::read_some(&mut self.source, buffer)?;
        let is_end = |byte: &u8| matches!(byte, b'\n' | b'\r');
        self.line = match buffer[..count].iter().rposition(is_end) {
            Some(at) => (count - at - 1) as u64,
            None => self.line + count as u64,
        };
        if self.line > LONGEST_LINE {
            let most = LONGEST_LINE >> 20;
            return Err(io::Error::other(format!("a line has more than {most} MiB")));
        }
        Ok(count)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_column_that_is_read_is_the_ten_thousandth() {
        let path = Path::new("a");
        assert_eq!(check_columns(path, MOST_COLUMNS), Ok(()));
        let most = MOST_COLUMNS;
        let error = FormatError::TooManyColumns { path: path.to_owned(), most };
        assert_eq!(check_columns(path, MOST_COLUMNS + 1), Err(error));
    }

    #[test]
    fn a_table_is_bounded_by_its_rows_and_by_its_numbers() {
        let path = Path::new("a");
        assert_eq!(check_size(path, MOST.rows, 10), Ok(()));
        let refusal =
            |columns, most| Err(FormatError::TooManyRows { path: path.to_owned(), columns, most });
        assert_eq!(check_size(path, MOST.rows + 1, 10), refusal(10, MOST.rows));
        assert_eq!(check_size(path, 100_000, MOST_COLUMNS), Ok(()));
        assert_eq!(check_size(path, 100_001, MOST_COLUMNS), refusal(MOST_COLUMNS, 100_000));
        assert_eq!(check_size(path, u64::MAX, usize::MAX), refusal(usize::MAX, 0));
    }

    #[test]
    fn a_line_is_counted_from_the_last_end_of_one() {
        let read = |text: &[u8]| BoundedLines::new(text).read_to_end(&mut Vec::new());
        let line = |bytes: u64| vec![b'1'; bytes as usize];
        assert_eq!(read(&line(LONGEST_LINE)).unwrap(), LONGEST_LINE as usize);
        assert!(read(&line(LONGEST_LINE + 1)).is_err());
        let two = [line(LONGEST_LINE - 9), b"\r".to_vec(), line(LONGEST_LINE - 9)].concat();
        assert_eq!(read(&two).unwrap(), two.len());
    }
}
