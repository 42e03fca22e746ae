use std::{
    collections::BTreeMap,
    fs::File,
    path::{Path, PathBuf},
};

use arrow_array::{
    Array, ArrowPrimitiveType, BooleanArray, RecordBatch,
    cast::AsArray,
    types::{
        Float32Type, Float64Type, Int8Type, Int16Type, Int32Type, Int64Type, UInt8Type, UInt16Type,
        UInt32Type, UInt64Type,
    },
};
use arrow_schema::{DataType, Schema};
use arrow_select::filter::filter_record_batch;
use parquet::arrow::{
    ProjectionMask,
    arrow_reader::{ArrowReaderOptions, ParquetRecordBatchReaderBuilder},
};

use crate::{
    LogError,
    excerpt::Excerpted,
    guarded::guarded,
    table::{Needed, Table},
};

/// Rows decoded at once: what is held besides the columns themselves stays small.
const BATCH_ROWS: usize = 4096;

/// What a damaged file is called.
pub(crate) const KIND: &str = "Parquet";

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

    /// Names of the columns, in the order of the file.
    pub(crate) fn names(&self) -> Result<Vec<String>, LogError> {
        guarded(&self.path, KIND, || {
            Ok(self.builder()?.schema().fields().iter().map(|f| f.name().clone()).collect())
        })
    }

    /// Columns by name: those that are needed, which must be numeric and without nulls, and of
    /// the rest those that are.
    pub(crate) fn load(&self, needed: &Needed) -> Result<Table, LogError> {
        guarded(&self.path, KIND, || self.decode(needed))
    }

    fn builder(&self) -> Result<Builder, LogError> {
        let file = self.file.try_clone().map_err(|e| LogError::unreadable(&self.path, &e))?;
        // The columns' own types are enough; the Arrow schema that a writer may have added
        // is one more thing that can be damaged.
        let options = ArrowReaderOptions::new().with_skip_arrow_metadata(true);
        Builder::try_new_with_options(file, options).map_err(|e| broken(&self.path, &e))
    }

    fn decode(&self, needed: &Needed) -> Result<Table, LogError> {
        let (path, builder) = (&self.path, self.builder()?);
        let wanted = wanted(path, builder.schema(), needed)?;
        let mask = ProjectionMask::roots(builder.parquet_schema(), wanted);
        let batches = builder
            .with_projection(mask)
            .with_batch_size(BATCH_ROWS)
            .build()
            .map_err(|e| broken(path, &e))?;
        let mut columns: BTreeMap<String, Option<Vec<f64>>> = BTreeMap::new();
        let mut excerpted = needed.excerpted.clone();
        let (mut rows, mut rows_read) = (0, Vec::new());
        for batch in batches {
            let batch = batch.map_err(|e| broken(path, &e))?;
            let first = rows + 1;
            rows += batch.num_rows();
            let is_read = |excerpted| is_read(&batch, needed.time, excerpted);
            let (batch, before) = match excerpted.as_mut().and_then(is_read) {
                None => (batch, first - 1),
                Some(is_read) => {
                    let before = rows_read.len();
                    let own = (first..).zip(is_read.values()).filter(|(_, is_read)| *is_read);
                    rows_read.extend(own.map(|(row, _)| row));
                    (filter_record_batch(&batch, &is_read).map_err(|e| broken(path, &e))?, before)
                }
            };
            for (field, array) in batch.schema().fields().iter().zip(batch.columns()) {
                let column =
                    columns.entry(field.name().clone()).or_insert_with(|| Some(Vec::new()));
                if let Some(index) = first_null(array) {
                    if needed.contains(field.name()) {
                        let row = rows_read.get(before + index).copied();
                        let row = row.unwrap_or(before + index + 1);
                        let column = field.name().clone();
                        return Err(LogError::MissingValue { path: path.clone(), row, column });
                    }
                    *column = None;
                }
                if let Some(samples) = column {
                    append(array, samples);
                }
            }
        }
        let whole = columns.into_iter().filter_map(|(name, column)| Some((name, column?)));
        Ok(Table { columns: whole.collect(), rows: rows_read })
    }
}

fn broken(path: &Path, error: &dyn std::fmt::Display) -> LogError {
    LogError::broken(path, KIND, error)
}

/// Which rows of a batch are read, as far as it has their times.
fn is_read(batch: &RecordBatch, time: &str, excerpted: &mut Excerpted) -> Option<BooleanArray> {
    let array = batch.column_by_name(time)?;
    let mut times = Vec::with_capacity(array.len());
    append(array, &mut times);
    let times = times.into_iter().enumerate();
    let times = times.map(|(k, time)| if array.is_null(k) { f64::NAN } else { time });
    Some(times.map(|time| Some(excerpted.reads(time))).collect())
}

/// Indices of the numeric columns; a needed one that is not numeric is an error.
fn wanted(path: &Path, schema: &Schema, needed: &Needed) -> Result<Vec<usize>, LogError> {
    let mut wanted = Vec::new();
    for (index, field) in schema.fields().iter().enumerate() {
        if field.data_type().is_integer() || is_float(field.data_type()) {
            wanted.push(index);
        } else if needed.contains(field.name()) {
            return Err(LogError::ColumnType {
                path: path.to_owned(),
                column: field.name().clone(),
                found: field.data_type().to_string(),
            });
        }
    }
    Ok(wanted)
}

fn is_float(kind: &DataType) -> bool {
    matches!(kind, DataType::Float32 | DataType::Float64)
}

fn first_null(array: &dyn Array) -> Option<usize> {
    let nulls = array.nulls().filter(|n| n.null_count() > 0)?;
    nulls.iter().position(|valid| !valid)
}

/// Appends an array of one of the types that [`wanted`] lets through.
fn append(array: &dyn Array, samples: &mut Vec<f64>) {
    match array.data_type() {
        DataType::Float64 => extend::<Float64Type>(array, samples, |x| x),
        DataType::Float32 => extend::<Float32Type>(array, samples, f64::from),
        DataType::Int8 => extend::<Int8Type>(array, samples, f64::from),
        DataType::Int16 => extend::<Int16Type>(array, samples, f64::from),
        DataType::Int32 => extend::<Int32Type>(array, samples, f64::from),
        DataType::Int64 => extend::<Int64Type>(array, samples, |x| x as f64),
        DataType::UInt8 => extend::<UInt8Type>(array, samples, f64::from),
        DataType::UInt16 => extend::<UInt16Type>(array, samples, f64::from),
        DataType::UInt32 => extend::<UInt32Type>(array, samples, f64::from),
        DataType::UInt64 => extend::<UInt64Type>(array, samples, |x| x as f64),
        _ => {}
    }
}

fn extend<T: ArrowPrimitiveType>(
    array: &dyn Array,
    samples: &mut Vec<f64>,
    convert: fn(T::Native) -> f64,
) {
    samples.extend(array.as_primitive::<T>().values().iter().map(|&x| convert(x)));
}
