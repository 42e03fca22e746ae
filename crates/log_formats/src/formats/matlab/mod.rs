//! MATLAB variables in MAT-files.

pub(crate) mod element;
pub(crate) mod matlab_file;
