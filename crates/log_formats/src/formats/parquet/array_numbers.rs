//! Numbers of Arrow arrays of any numeric type.

use arrow_array::{
    Array, ArrowPrimitiveType,
    cast::AsArray,
    types::{
        Float32Type, Float64Type, Int8Type, Int16Type, Int32Type, Int64Type, UInt8Type, UInt16Type,
        UInt32Type, UInt64Type,
    },
};
use arrow_schema::DataType;

/// Whether this type is one of numbers that a log may have.
pub(crate) fn is_number(kind: &DataType) -> bool {
    kind.is_integer() || matches!(kind, DataType::Float32 | DataType::Float64)
}

/// Index of the first missing entry.
pub(crate) fn first_null(array: &dyn Array) -> Option<usize> {
    let nulls = array.nulls().filter(|n| n.null_count() > 0)?;
    nulls.iter().position(|valid| !valid)
}

/// Appends an array of a type that [`is_number`] accepts.
pub(crate) fn append(array: &dyn Array, samples: &mut Vec<f64>) {
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
