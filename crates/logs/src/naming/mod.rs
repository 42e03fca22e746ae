//! Names and units of columns, and which signals of a robot they are.

pub(crate) mod column_map;
pub(crate) mod map_entry;
pub(crate) mod map_pattern;
pub(crate) mod nearest;
pub(crate) mod unit;
