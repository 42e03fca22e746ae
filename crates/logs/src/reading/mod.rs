//! Reads a file into a checked run.

pub(crate) mod even_rows;
pub(crate) mod finder;
pub(crate) mod held_values;
pub(crate) mod options;
pub(crate) mod overview;
pub(crate) mod plan;
pub(crate) mod position_loop;
pub(crate) mod presets;
pub(crate) mod read;
pub(crate) mod source;
