//! Logs that are named arrays, as numerical programs save their variables.

pub(crate) mod array;
pub(crate) mod array_file;
pub(crate) mod hdf5_tree;
