//! Arrays of NumPy, one (npy) or several by name (npz).

pub(crate) mod literal;
pub(crate) mod npy_header;
pub(crate) mod numpy_array;
pub(crate) mod numpy_file;
