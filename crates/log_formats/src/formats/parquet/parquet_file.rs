use std::{
    collections::BTreeSet,
    fs::File,
    ops::Range,
    path::{Path, PathBuf},
};

use arrow_array::{Array, BooleanArray, RecordBatch};
use arrow_schema::{DataType, Schema};
use arrow_select::filter::filter_record_batch;
use parquet::arrow::{
    ProjectionMask,
    arrow_reader::{ArrowReaderOptions, ParquetRecordBatchReaderBuilder, RowSelection},
};

use crate::{
    common::{
        allowance::Allowance,
        bounds::{check_columns, check_size},
        damage::Damage,
        error::FormatError,
        excerpt::ExcerptFilter,
        guard::guard,
        sha256::sha256_of_files,
        table::{Needed, Table},
    },
    file_format::{FileFormat, Magic, Opened, Request},
    formats::parquet::{
        array_numbers::{append, is_number},
        date_columns::{DateColumns, column_name, is_date},
        growing_columns::GrowingColumns,
        list_column,
        nesting::check_parquet_nesting,
    },
};

/// Number of rows decoded at once. It is small to limit the memory besides the columns themselves.
const BATCH_ROWS: usize = 4096;

/// Size of a number that is kept (bytes).
const CELL: u64 = 8;

/// Name of the format in errors.
const NAME: &str = "Parquet";

/// Tables of Parquet.
pub(crate) struct Parquet;

impl FileFormat for Parquet {
    fn name(&self) -> &'static str {
        NAME
    }

    fn magic(&self) -> &'static [Magic] {
        &[(0, b"PAR1")]
    }

    fn extension(&self) -> Option<&'static str> {
        Some("parquet")
    }

    fn open(
        &self,
        path: &Path,
        file: File,
        _: &Request,
        _: &mut Damage,
    ) -> Result<Box<dyn Opened>, FormatError> {
        Ok(Box::new(ParquetFile::open(path, file)))
    }
}

/// Whether numeric columns that are not needed are read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Further {
    Read,
    LeftOut,
}

type Builder = ParquetRecordBatchReaderBuilder<File>;

/// A log as a Parquet file.
pub(crate) struct ParquetFile {
    path: PathBuf,
    file: File,
}

impl ParquetFile {
    pub(crate) fn open(path: &Path, file: File) -> Self {
        Self { path: path.to_owned(), file }
    }

    /// The file.
    pub(crate) fn path(&self) -> &Path {
        &self.path
    }

    /// Names of the columns. A column `q` of lists is `q[0]`, `q[1]` and so on, as many as the first list has numbers.
    fn read_names(&self) -> Result<Vec<String>, FormatError> {
        let builder = self.builder()?;
        let schema = builder.schema().clone();
        let lists = (0..schema.fields().len()).filter(|&k| is_list(schema.field(k).data_type()));
        let mask = ProjectionMask::roots(builder.parquet_schema(), lists);
        let first = builder.with_projection(mask).with_limit(1).build();
        let first = first.map_err(|e| broken(&self.path, &e))?.next().transpose();
        let first = first.map_err(|e| broken(&self.path, &e))?;
        let numbers = |name: &str| list_column::width(first.as_ref()?.column_by_name(name)?);
        let mut names = Vec::new();
        for field in schema.fields() {
            match numbers(field.name()) {
                Some(width) => {
                    names.extend((0..width).map(|k| list_column::part_name(field.name(), k)));
                }
                None => names.push(column_name(&schema, field).to_owned()),
            }
            check_columns(&self.path, names.len())?;
        }
        Ok(names)
    }

    /// Columns by name, for all rows of the file or some. A needed column must be numeric and without nulls. Any other
    /// column is kept if it is. A column of lists is read only if one of its entries is needed.
    pub(crate) fn load_rows(
        &self,
        needed: &Needed,
        rows: Option<&[Range<usize>]>,
    ) -> Result<Table, FormatError> {
        guard(&self.path, NAME, || self.decode(needed, rows, Further::Read))
    }

    /// A single column of numbers.
    pub(crate) fn load_column(&self, column: &str) -> Result<Vec<f64>, FormatError> {
        let absent = || FormatError::NoColumn {
            path: self.path.clone(),
            column: column.to_owned(),
            purpose: "the episode of every row was expected there".to_owned(),
            nearest: None,
            found: self.names().unwrap_or_default().into(),
        };
        let needed = Needed { time: column, signals: BTreeSet::new(), excerpt: None };
        let mut table = guard(&self.path, NAME, || self.decode(&needed, None, Further::LeftOut))?;
        table.columns.remove(column).ok_or_else(absent)
    }

    fn builder(&self) -> Result<Builder, FormatError> {
        let file = self.file.try_clone().map_err(|e| FormatError::unreadable(&self.path, &e))?;
        // The columns' own types are enough; the Arrow schema that a writer may have added
        // is one more thing that can be damaged.
        check_parquet_nesting(&file).map_err(|reason| broken(&self.path, &reason))?;
        let options = ArrowReaderOptions::new().with_skip_arrow_metadata(true);
        Builder::try_new_with_options(file, options).map_err(|e| broken(&self.path, &e))
    }

    fn decode(
        &self,
        needed: &Needed,
        rows: Option<&[Range<usize>]>,
        further: Further,
    ) -> Result<Table, FormatError> {
        let (path, mut builder) = (&self.path, self.builder()?);
        let mut wanted = wanted_columns(path, builder.schema(), needed)?;
        if further == Further::LeftOut {
            let schema = builder.schema();
            wanted.retain(|&index| needed.contains(column_name(schema, schema.field(index))));
        }
        let mask = ProjectionMask::roots(builder.parquet_schema(), wanted);
        if let Some(rows) = rows {
            let all = usize::try_from(builder.metadata().file_metadata().num_rows()).unwrap_or(0);
            let selected = RowSelection::from_consecutive_ranges(rows.iter().cloned(), all);
            builder = builder.with_row_selection(selected);
        }
        let batches = builder
            .with_projection(mask)
            .with_batch_size(BATCH_ROWS)
            .build()
            .map_err(|e| broken(path, &e))?;
        let mut filter = needed.excerpt.clone();
        let (mut dates, mut columns) = (DateColumns::default(), GrowingColumns::default());
        let length = self.file.metadata().map_err(|e| FormatError::unreadable(path, &e))?.len();
        let mut allowance = Allowance::of(length);
        for batch in batches {
            let batch = batch.map_err(|e| broken(path, &e))?;
            let cells = batch.num_rows().saturating_mul(batch.num_columns());
            let unpacked = allowance.take(CELL.saturating_mul(cells as u64));
            unpacked.map_err(|e| FormatError::too_large(path, e))?;
            let batch = dates.count_seconds(batch).map_err(|e| broken(path, &e))?;
            let is_read = filter.as_mut().and_then(|e| is_read(&batch, needed.time, e));
            columns.begin_batch(batch.num_rows(), is_read.as_ref());
            let batch = match is_read {
                None => batch,
                Some(is_read) => {
                    filter_record_batch(&batch, &is_read).map_err(|e| broken(path, &e))?
                }
            };
            for (field, array) in batch.schema().fields().iter().zip(batch.columns()) {
                let parts = list_column::parts(field.name(), array).map_err(|found| {
                    let (path, column) = (path.clone(), field.name().clone());
                    FormatError::ColumnType { path, column, found }
                })?;
                for (name, array) in parts {
                    columns.add(path, &name, &array, needed)?;
                }
            }
            let samples = columns.end_batch(batch.num_rows());
            check_size(path, samples as u64, batch.num_columns())?;
        }
        columns.finish(path, needed)
    }
}

impl Opened for ParquetFile {
    fn names(&self) -> Result<Vec<String>, FormatError> {
        guard(&self.path, NAME, || self.read_names())
    }

    fn load(&self, needed: &Needed, _: &mut Damage) -> Result<Table, FormatError> {
        self.load_rows(needed, None)
    }

    fn sha256(&self) -> Result<String, FormatError> {
        sha256_of_files([self.path.as_path()])
    }
}

fn broken(path: &Path, error: &dyn std::fmt::Display) -> FormatError {
    FormatError::broken(path, NAME, error)
}

/// The rows of a batch that are read; `None` where the batch has no times to tell.
fn is_read(batch: &RecordBatch, time: &str, filter: &mut ExcerptFilter) -> Option<BooleanArray> {
    let array = batch.column_by_name(time)?;
    let mut times = Vec::with_capacity(array.len());
    append(array, &mut times);
    let times = times.into_iter().enumerate();
    let times = times.map(|(k, time)| if array.is_null(k) { f64::NAN } else { time });
    Some(times.map(|time| Some(filter.takes(time))).collect())
}

/// Indices of the numeric columns; a needed one that is not numeric is an error.
fn wanted_columns(
    path: &Path,
    schema: &Schema,
    needed: &Needed,
) -> Result<Vec<usize>, FormatError> {
    let mut wanted = Vec::new();
    for (index, field) in schema.fields().iter().enumerate() {
        let is_needed_list = || {
            let parts = format!("{}[", field.name());
            is_list(field.data_type()) && needed.signals.iter().any(|s| s.starts_with(&parts))
        };
        if is_number(field.data_type()) || is_date(field.data_type()) || is_needed_list() {
            wanted.push(index);
        } else if needed.contains(field.name()) {
            return Err(FormatError::ColumnType {
                path: path.to_owned(),
                column: field.name().clone(),
                found: field.data_type().to_string(),
            });
        }
    }
    Ok(wanted)
}

/// Whether this type is a list of numbers.
fn is_list(kind: &DataType) -> bool {
    matches!(kind, DataType::List(entry) if is_number(entry.data_type()))
}
