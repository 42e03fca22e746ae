//! What changed between two sets of logs.

pub(crate) mod json;
pub(crate) mod page;
