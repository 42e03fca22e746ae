//! NumPy arrays: a single one (npy), or several named ones (npz).

pub(crate) mod literal;
pub(crate) mod npy_header;
pub(crate) mod numpy_array;
pub(crate) mod numpy_file;
