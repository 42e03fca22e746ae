//! Logs as loggers, drivers and their configuration spoil them.

pub(crate) mod channels;
pub(crate) mod clocks;
pub(crate) mod efforts;
pub(crate) mod held_values;
pub(crate) mod log_damage;
pub(crate) mod moments;
pub(crate) mod normalised_units;
pub(crate) mod rows;
pub(crate) mod stated_limit;
