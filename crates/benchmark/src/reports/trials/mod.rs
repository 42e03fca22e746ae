//! Pages of blind trials.

pub(crate) mod confusion_figure;
pub(crate) mod corner_figure;
pub(crate) mod page;
pub(crate) mod panel_page;
pub(crate) mod table;
