//! Variables as MATLAB saves them.

pub(crate) mod element;
pub(crate) mod matlab_file;
