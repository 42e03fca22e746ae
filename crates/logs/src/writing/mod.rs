//! Runs and tables as files that appear whole, and logs that grow row by row.

pub(crate) mod whole_file;
pub(crate) mod write;
pub(crate) mod writer;
