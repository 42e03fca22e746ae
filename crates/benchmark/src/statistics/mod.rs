//! Shares and rates with their intervals, and tables of text.

pub(crate) mod median;
pub(crate) mod middle;
pub(crate) mod rate;
pub(crate) mod share;
pub(crate) mod text_table;
