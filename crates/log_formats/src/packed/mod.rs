//! Files that are packed with gzip or zstd around another kind.

pub(crate) mod unpack;
