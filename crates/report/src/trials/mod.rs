//! Blind trials as a page.

mod confusion_figure;
mod page;

pub use page::trials_page;
