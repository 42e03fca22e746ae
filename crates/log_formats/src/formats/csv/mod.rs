//! Text: rows of numbers, below a line of names or without one.

pub(crate) mod csv_file;
pub(crate) mod dialect;
