//! What changed between two sets of logs.

pub(crate) mod page;
