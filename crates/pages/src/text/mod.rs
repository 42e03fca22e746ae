//! Numbers, units, names and lines, as people read them.

pub(crate) mod names;
pub(crate) mod numbers;
pub(crate) mod terminal;
pub(crate) mod wrap;
