use std::fs::File;
use std::panic::catch_unwind;
use std::path::Path;
use std::sync::Arc;

use arrow_array::cast::AsArray;
use arrow_array::types::UInt64Type;
use arrow_array::{Array, ArrayRef, BooleanArray, RecordBatch, StringArray, UInt64Array};
use logs::LogError;
use parquet::arrow::arrow_reader::ParquetRecordBatchReaderBuilder;

use super::{Hidden, Score};

/// What came of one trial of a campaign: a row of a table.
#[derive(Debug, Clone, PartialEq)]
pub struct Record {
    /// Its number in the campaign, from 0.
    pub task: usize,
    /// What was hidden.
    pub hidden: Hidden,
    /// The seed that everything was drawn from.
    pub seed: u64,
    /// The campaign, by its hash.
    pub campaign: String,
    /// The score, or in words why it has none.
    pub score: Result<Score, String>,
}

impl Record {
    /// Writes records as Parquet, one row each: `task`, `hidden`, `seed`, `campaign`, `error`
    /// where there is no score, and otherwise `verdict`, `exactly`, `as_one_of`, the number of
    /// `stray` findings, and the whole `score` as JSON.
    ///
    /// # Errors
    ///
    /// [`LogError::Unwritable`]; what was there before stays.
    pub fn write(path: &Path, records: &[Self]) -> Result<(), LogError> {
        let unwritable = |e: serde_json::Error| LogError::Unwritable {
            path: path.to_owned(),
            reason: e.to_string(),
        };
        let json = |record: &Self| record.scored().map(serde_json::to_string).transpose();
        let json = records.iter().map(json).collect::<Result<Vec<_>, _>>().map_err(unwritable)?;
        let numbers = |of: fn(&Self) -> u64| -> ArrayRef {
            Arc::new(records.iter().map(of).map(Some).collect::<UInt64Array>())
        };
        let texts = |of: fn(&Self) -> Option<String>| -> ArrayRef {
            Arc::new(records.iter().map(of).collect::<StringArray>())
        };
        let answers = |of: fn(&Score) -> bool| -> ArrayRef {
            Arc::new(records.iter().map(|r| r.scored().map(of)).collect::<BooleanArray>())
        };
        let stray = records.iter().map(|r| r.scored().map(|score| score.stray.len() as u64));
        let columns = [
            ("task", numbers(|r| r.task as u64)),
            ("hidden", texts(|r| Some(r.hidden.to_string()))),
            ("seed", numbers(|r| r.seed)),
            ("campaign", texts(|r| Some(r.campaign.clone()))),
            ("verdict", texts(|r| r.scored().map(|score| score.verdict.words().to_owned()))),
            ("exactly", answers(|score| score.exactly)),
            ("as_one_of", answers(|score| score.as_one_of)),
            ("stray", Arc::new(stray.collect::<UInt64Array>())),
            ("error", texts(|r| r.score.clone().err())),
            ("score", Arc::new(json.into_iter().collect::<StringArray>())),
        ];
        let columns = columns.map(|(name, column)| (name.to_owned(), column));
        logs::write_table(path, columns.to_vec(), Vec::new())
    }

    /// Reads what [`write`](Self::write) has written; in words what is wrong with the file.
    ///
    /// # Errors
    ///
    /// A sentence, for a file that cannot be read or does not hold records.
    pub fn read(path: &Path) -> Result<Vec<Self>, String> {
        // The decoder panics at some damaged files instead of refusing them.
        catch_unwind(|| read(path)).unwrap_or_else(|_| Err("the decoder gave up".to_owned()))
    }

    /// The score, if there is one.
    pub fn scored(&self) -> Option<&Score> {
        self.score.as_ref().ok()
    }
}

fn read(path: &Path) -> Result<Vec<Record>, String> {
    let file = File::open(path).map_err(|e| e.to_string())?;
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
    let score = match (text("score"), text("error")) {
        (Ok(json), _) => {
            Ok(serde_json::from_str(json).map_err(|e| format!("its score is none: {e}"))?)
        }
        (Err(_), Ok(error)) => Err(error.to_owned()),
        (Err(lack), Err(_)) => return Err(format!("{lack} and no error")),
    };
    let task = usize::try_from(number("task")?).map_err(|e| e.to_string())?;
    let hidden = text("hidden")?.parse().map_err(|e: catalogue::UnknownEffect| e.to_string())?;
    Ok(Record {
        task,
        hidden,
        seed: number("seed")?,
        campaign: text("campaign")?.to_owned(),
        score,
    })
}
