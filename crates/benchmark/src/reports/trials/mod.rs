//! Pages of blind trials.

pub(crate) mod corner_figure;
pub(crate) mod panel_page;
pub(crate) mod table;
