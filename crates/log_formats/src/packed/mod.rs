//! Files of another kind that are packed with gzip or zstd.

pub(crate) mod unpack;
