//! A folder a format, and the list of them.

pub(crate) mod bag;
pub(crate) mod csv;
pub(crate) mod hdf5;
pub(crate) mod lerobot;
pub(crate) mod matlab;
pub(crate) mod numpy;
pub(crate) mod parquet;

use crate::content::Formats;

/// Every kind of file that is read. Those that bytes tell are looked for in this order; what is text and
/// nothing else is CSV.
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
