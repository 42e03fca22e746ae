//! The supported formats, one folder per format, and their list.

pub(crate) mod bag;
pub(crate) mod csv;
pub(crate) mod hdf5;
pub(crate) mod lerobot;
pub(crate) mod matlab;
pub(crate) mod numpy;
pub(crate) mod parquet;

use crate::content::Formats;

/// All supported kinds of file. Those identified by their bytes are tried in this order. Any other
/// text is CSV.
pub(crate) const FORMATS: Formats = Formats {
    by_magic: &[
        &parquet::parquet_file::Parquet,
        &numpy::numpy_file::Npy,
        &numpy::numpy_file::Npz,
        &matlab::matlab_file::Matlab5,
        &matlab::matlab_file::Matlab73,
        &hdf5::Hdf5,
        &bag::storage::MCAP,
        &bag::storage::SQLITE,
    ],
    text: &csv::csv_file::Csv,
};
