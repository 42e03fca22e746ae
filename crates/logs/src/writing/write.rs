use std::{io::Write, path::Path, sync::Arc};

use arrow_array::{Array, ArrayRef, Float64Array, RecordBatch};
use arrow_schema::{Field, Schema};
use parquet::{
    arrow::ArrowWriter,
    basic::Compression,
    file::{metadata::KeyValue, properties::WriterProperties},
};

use crate::{
    error::LogError,
    runs::run::{Channel, Run},
    writing::whole_file::WholeFile,
};

/// Writes a file that appears under its name only when it is complete, by a [`WholeFile`].
///
/// # Errors
///
/// [`LogError::Unwritable`]. An earlier file of that name is then untouched.
pub fn replace_file(
    path: &Path,
    fill: impl FnOnce(&mut WholeFile) -> Result<(), Box<dyn std::error::Error>>,
) -> Result<(), LogError> {
    let unwritable = |reason: String| LogError::Unwritable { path: path.to_owned(), reason };
    let mut file = WholeFile::create(path).map_err(|e| unwritable(e.to_string()))?;
    fill(&mut file).map_err(|e| unwritable(e.to_string()))?;
    file.finish().map_err(|e| unwritable(e.to_string()))
}

/// Writes columns of equal length as Parquet. The metadata of the file gets the given texts, by key.
///
/// # Errors
///
/// [`LogError::Unwritable`].
pub fn write_table(
    path: &Path,
    columns: Vec<(String, ArrayRef)>,
    metadata: Vec<KeyValue>,
) -> Result<(), LogError> {
    replace_file(path, |file| encode(file, columns, metadata))
}

/// The bytes of the Parquet file that [`write_table`] writes.
///
/// # Errors
///
/// [`LogError::Unwritable`] with `path`, the path of the intended file.
pub fn table_bytes(
    path: &Path,
    columns: Vec<(String, ArrayRef)>,
    metadata: Vec<KeyValue>,
) -> Result<Vec<u8>, LogError> {
    let mut bytes = Vec::new();
    encode(&mut bytes, columns, metadata)
        .map_err(|e| LogError::Unwritable { path: path.to_owned(), reason: e.to_string() })?;
    Ok(bytes)
}

fn encode(
    into: impl Write + Send,
    columns: Vec<(String, ArrayRef)>,
    metadata: Vec<KeyValue>,
) -> Result<(), Box<dyn std::error::Error>> {
    let field = |(name, array): &(String, ArrayRef)| {
        Field::new(name, array.data_type().clone(), array.is_nullable())
    };
    let schema = Arc::new(Schema::new(columns.iter().map(field).collect::<Vec<_>>()));
    let arrays = columns.into_iter().map(|(_, array)| array).collect();
    let batch = RecordBatch::try_new(schema.clone(), arrays)?;
    let properties = WriterProperties::builder()
        .set_compression(Compression::SNAPPY)
        .set_key_value_metadata(Some(metadata).filter(|texts| !texts.is_empty()))
        .build();
    let mut writer = ArrowWriter::try_new(into, schema, Some(properties))?;
    writer.write(&batch)?;
    writer.close()?;
    Ok(())
}

/// Writes a run as Parquet, one `f64` column per signal. Reading the file returns exactly the same numbers.
///
/// # Errors
///
/// [`LogError::Unwritable`].
pub fn write_parquet(path: &Path, run: &Run) -> Result<(), LogError> {
    write_columns(path, &columns(run))
}

/// Writes columns of equal length as Parquet, one `f64` column each.
///
/// # Errors
///
/// [`LogError::Unwritable`].
pub fn write_columns<C: AsRef<[f64]>>(
    path: &Path,
    columns: &[(String, C)],
) -> Result<(), LogError> {
    let array = |x: &C| Arc::new(Float64Array::from(x.as_ref().to_vec())) as ArrayRef;
    let columns = columns.iter().map(|(name, x)| (name.clone(), array(x)));
    write_table(path, columns.collect(), Vec::new())
}

/// Writes a run as CSV with a header. Reading the file returns exactly the same numbers.
///
/// # Errors
///
/// [`LogError::Unwritable`].
pub fn write_csv(path: &Path, run: &Run) -> Result<(), LogError> {
    let columns = columns(run);
    replace_file(path, |file| {
        let mut writer = csv::Writer::from_writer(&mut *file);
        writer.write_record(columns.iter().map(|(name, _)| name))?;
        for row in 0..run.time.len() {
            // `{}` prints the shortest number that reads back to the same f64.
            let field =
                |(_, x): &(String, &[f64])| x.get(row).map(f64::to_string).unwrap_or_default();
            writer.write_record(columns.iter().map(field))?;
        }
        writer.flush()?;
        Ok(())
    })
}

/// Name of the column of a joint's signal.
pub(crate) fn column_name(joint: &str, channel: Channel) -> String {
    format!("{joint}.{}", channel.suffix())
}

/// Names and samples of all columns, in the order of the file.
fn columns(run: &Run) -> Vec<(String, &[f64])> {
    let mut columns = vec![("time".to_owned(), run.time.as_slice())];
    for channel in Channel::ALL {
        for joint in &run.joints {
            if let Some(samples) = joint.get(channel) {
                columns.push((column_name(&joint.name, channel), samples));
            }
        }
    }
    columns.extend(run.extra.iter().map(|(name, x)| (name.clone(), x.as_slice())));
    columns
}
