//! Tables in text: rows of numbers, with or without a line of names above them.

pub(crate) mod csv_file;
pub(crate) mod dialect;
pub(crate) mod listed_names;
