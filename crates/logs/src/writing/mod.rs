//! Writes runs and tables as whole files, and logs row by row while they are recorded.

pub(crate) mod leftovers;
pub(crate) mod npz;
pub(crate) mod whole_file;
pub(crate) mod write;
pub(crate) mod writer;
