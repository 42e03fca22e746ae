//! Bags in MCAP files.

pub(crate) mod mcap_file;
pub(crate) mod record;
