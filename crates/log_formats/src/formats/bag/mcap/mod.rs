//! Bags in files of MCAP.

pub(crate) mod mcap_file;
pub(crate) mod record;
