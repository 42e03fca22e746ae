//! Parquet tables, with columns of numbers and of lists.

pub(crate) mod array_numbers;
pub(crate) mod date_columns;
pub(crate) mod growing_columns;
pub(crate) mod list_column;
pub(crate) mod nesting;
pub(crate) mod parquet_file;
