use std::{collections::BTreeMap, path::Path};

use arrow_array::{Array, BooleanArray};

use crate::{
    common::{
        error::FormatError,
        table::{Needed, Table},
    },
    formats::parquet::array_numbers::{append, first_null},
};

/// Columns that grow by one batch of rows at a time.
#[derive(Default)]
pub(crate) struct GrowingColumns {
    /// Samples by name; `None` for a column with a missing value.
    columns: BTreeMap<String, Option<Vec<f64>>>,
    /// Number of samples in each column before this batch.
    samples: usize,
    /// Number of rows of the file up to the end of this batch.
    seen: usize,
    /// The row of the file for each sample, including this batch; empty where all rows are read.
    rows: Vec<usize>,
    is_excerpt: bool,
}

impl GrowingColumns {
    /// Counts the rows of the next batch. `is_read` selects the rows that are read; `None` selects all.
    pub(crate) fn begin_batch(&mut self, rows: usize, is_read: Option<&BooleanArray>) {
        if let Some(is_read) = is_read {
            let numbered = (self.seen + 1..).zip(is_read.values());
            self.rows.extend(numbered.filter(|(_, is_read)| *is_read).map(|(row, _)| row));
            self.is_excerpt = true;
        }
        self.seen += rows;
    }

    /// Adds a column of the batch.
    pub(crate) fn add(
        &mut self,
        path: &Path,
        name: &str,
        array: &dyn Array,
        needed: &Needed,
    ) -> Result<(), FormatError> {
        let column = self.columns.entry(name.to_owned()).or_insert_with(|| Some(Vec::new()));
        if let Some(index) = first_null(array) {
            if needed.contains(name) {
                let sample = self.samples + index;
                let row = self.rows.get(sample).copied().unwrap_or(sample + 1);
                let (path, column) = (path.to_owned(), name.to_owned());
                return Err(FormatError::MissingValue { path, row, column });
            }
            *column = None;
        }
        if let Some(samples) = column {
            append(array, samples);
        }
        Ok(())
    }

    /// Ends a batch, `rows` of whose rows were read, and gives the number of samples so far.
    pub(crate) fn end_batch(&mut self, rows: usize) -> usize {
        self.samples += rows;
        self.samples
    }

    /// The table. A column is too short where lists further down have another length; this is an error. Where time is
    /// an entry of a list, the excerpt is taken here.
    pub(crate) fn finish(self, path: &Path, needed: &Needed) -> Result<Table, FormatError> {
        let whole = self.columns.into_iter().filter_map(|(name, column)| Some((name, column?)));
        let columns: BTreeMap<String, Vec<f64>> = whole.collect();
        match columns.iter().find(|(_, samples)| samples.len() != self.samples) {
            Some((column, _)) => Err(FormatError::ColumnType {
                path: path.to_owned(),
                column: column.clone(),
                found: "lists of different lengths".to_owned(),
            }),
            None if self.is_excerpt => Ok(Table { columns, rows: self.rows }),
            None => Ok(Table { columns, ..Table::default() }.excerpt(needed)),
        }
    }
}
