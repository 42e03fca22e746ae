//! Blind trials as a page.

mod confusion_figure;
mod corner_figure;
mod page;
mod panel_page;
mod table;

pub use page::trials_page;
pub use panel_page::panel_page;
