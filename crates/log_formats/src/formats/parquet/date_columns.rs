use std::{collections::BTreeMap, sync::Arc};

use arrow_array::{
    Array, ArrayRef, Float64Array, RecordBatch,
    cast::AsArray,
    types::{
        TimestampMicrosecondType, TimestampMillisecondType, TimestampNanosecondType,
        TimestampSecondType,
    },
};
use arrow_schema::{ArrowError, DataType, Field, Schema, TimeUnit};

use crate::common::dates::{Dates, TIME};

/// Name that pandas gives an index without one.
const INDEX: &str = "__index_level_0__";

/// Columns of dates, which become seconds from the first date of each.
#[derive(Default)]
pub(crate) struct DateColumns {
    dates: BTreeMap<String, Dates>,
}

impl DateColumns {
    /// A batch whose dates are seconds. A date beyond the range of nanoseconds in 64 bits is a missing value.
    ///
    /// # Errors
    ///
    /// Those of [`RecordBatch::try_new`].
    pub(crate) fn count_seconds(&mut self, batch: RecordBatch) -> Result<RecordBatch, ArrowError> {
        let schema = batch.schema();
        if !schema.fields().iter().any(|field| is_date(field.data_type())) {
            return Ok(batch);
        }
        let mut fields = Vec::new();
        let mut columns: Vec<ArrayRef> = Vec::new();
        for (field, array) in schema.fields().iter().zip(batch.columns()) {
            if is_date(field.data_type()) {
                let name = column_name(&schema, field);
                let dates = self.dates.entry(name.to_owned()).or_default();
                let seconds = nanoseconds(array)
                    .into_iter()
                    .map(|date| date.map(|date_ns| dates.seconds(date_ns)))
                    .collect::<Float64Array>();
                fields.push(Arc::new(Field::new(name, DataType::Float64, true)));
                columns.push(Arc::new(seconds));
            } else {
                fields.push(field.clone());
                columns.push(array.clone());
            }
        }
        RecordBatch::try_new(Arc::new(Schema::new(fields)), columns)
    }
}

/// Whether a column of this type holds dates with their time.
pub(crate) fn is_date(kind: &DataType) -> bool {
    matches!(kind, DataType::Timestamp(..))
}

/// The name of a column: `time` for an index of dates without a name, where no other column is called so.
pub(crate) fn column_name<'a>(schema: &Schema, field: &'a Field) -> &'a str {
    let is_index = field.name() == INDEX && is_date(field.data_type());
    match is_index && schema.column_with_name(TIME).is_none() {
        true => TIME,
        false => field.name(),
    }
}

/// The dates in nanoseconds since 1970.
fn nanoseconds(array: &dyn Array) -> Vec<Option<i64>> {
    let scaled = |values: &[i64], scale: i64| {
        let dates = values.iter().enumerate();
        dates.map(|(k, date)| date.checked_mul(scale).filter(|_| array.is_valid(k))).collect()
    };
    match array.data_type() {
        DataType::Timestamp(TimeUnit::Second, _) => {
            scaled(array.as_primitive::<TimestampSecondType>().values(), 1_000_000_000)
        }
        DataType::Timestamp(TimeUnit::Millisecond, _) => {
            scaled(array.as_primitive::<TimestampMillisecondType>().values(), 1_000_000)
        }
        DataType::Timestamp(TimeUnit::Microsecond, _) => {
            scaled(array.as_primitive::<TimestampMicrosecondType>().values(), 1_000)
        }
        DataType::Timestamp(TimeUnit::Nanosecond, _) => {
            scaled(array.as_primitive::<TimestampNanosecondType>().values(), 1)
        }
        _ => vec![None; array.len()],
    }
}
