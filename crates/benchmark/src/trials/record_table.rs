use std::panic::catch_unwind;
use std::path::Path;

use arrow_array::cast::AsArray;
use arrow_array::types::UInt64Type;
use arrow_array::{Array, RecordBatch};
use logs::LogError;
use parquet::arrow::arrow_reader::ParquetRecordBatchReaderBuilder;

use crate::trials::record::Record;
use crate::trials::record_columns;

impl Record {
    /// Writes the records of a campaign as Parquet, one row each: `task`, `seed`, `campaign`, `error` where there is
    /// no score, the whole `score` as JSON, and the columns that tables are sorted by: `hidden` for the arm of a
    /// scenario, `arm`, `motion`, `verdict`, `right`, numbers of `findings`, `true_findings`, `visible` and `named`
    /// causes, `false_assurance`, `false_alarm`, `misled`, `worse`, `worse_than_by_hand`, `diagnosis_s`.
    ///
    /// # Errors
    ///
    /// [`LogError::Unwritable`]; an existing file then stays.
    pub fn write(path: &Path, records: &[Self]) -> Result<(), LogError> {
        let unwritable = |e: serde_json::Error| LogError::Unwritable {
            path: path.to_owned(),
            reason: e.to_string(),
        };
        let columns = record_columns::all(records).map_err(unwritable)?;
        let named = columns.into_iter().map(|(name, column)| (name.to_owned(), column));
        logs::write_table(path, named.collect(), Vec::new())
    }

    /// Reads a file that [`write`](Self::write) has written.
    ///
    /// # Errors
    ///
    /// A sentence, for a file that cannot be read or does not hold records.
    pub fn read(path: &Path) -> Result<Vec<Self>, String> {
        // The decoder panics at some damaged files instead of refusing them.
        catch_unwind(|| read(path)).unwrap_or_else(|_| Err("the decoder gave up".to_owned()))
    }
}

fn read(path: &Path) -> Result<Vec<Record>, String> {
    let file = files::open(path).map_err(|e| e.to_string())?;
    logs::check_parquet_nesting(&file)?;
    let builder = ParquetRecordBatchReaderBuilder::try_new(file).map_err(|e| e.to_string())?;
    let mut records = Vec::new();
    for batch in builder.build().map_err(|e| e.to_string())? {
        let batch = batch.map_err(|e| e.to_string())?;
        for row in 0..batch.num_rows() {
            records.push(record(&batch, row)?);
        }
    }
    Ok(records)
}

fn record(batch: &RecordBatch, row: usize) -> Result<Record, String> {
    let lacks = |name: &str| format!("row {} has no {name}", row + 1);
    let column = |name| batch.column_by_name(name).filter(|column| column.is_valid(row));
    let number = |name| {
        let numbers = column(name).and_then(|column| column.as_primitive_opt::<UInt64Type>());
        numbers.map(|numbers| numbers.value(row)).ok_or_else(|| lacks(name))
    };
    let text = |name| {
        let texts = column(name).and_then(|column| column.as_string_opt::<i32>());
        texts.map(|texts| texts.value(row)).ok_or_else(|| lacks(name))
    };
    let hidden = match text("hidden") {
        Ok(name) => Some(name.parse().map_err(|e: catalogue::UnknownEffect| e.to_string())?),
        Err(_) => None,
    };
    let score = match (text("score"), text("error")) {
        (Ok(json), _) => Ok(serde_json::from_str(json)
            .map_err(|e| format!("its score is none of this judge: {e}"))?),
        (Err(_), Ok(error)) => Err(error.to_owned()),
        (Err(lack), Err(_)) => return Err(format!("{lack} and no error")),
    };
    let task = usize::try_from(number("task")?).map_err(|e| e.to_string())?;
    let (seed, campaign) = (number("seed")?, text("campaign")?.to_owned());
    Ok(Record { task, hidden, seed, campaign, score })
}
