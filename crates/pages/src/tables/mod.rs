//! Tables of numbers, in a terminal and in a page.

pub(crate) mod grid;
pub(crate) mod html_grid;
