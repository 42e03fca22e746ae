//! Names and units of columns, and the signals of a robot that they hold.

pub(crate) mod column_map;
pub(crate) mod map_entry;
pub(crate) mod map_pattern;
pub(crate) mod nearest;
pub(crate) mod time_name;
pub(crate) mod unit;
