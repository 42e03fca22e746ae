//! Logs that are arrays by name, as programs for numbers save their variables.

pub(crate) mod array;
pub(crate) mod array_file;
pub(crate) mod hdf5_tree;
