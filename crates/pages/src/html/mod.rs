//! The frame of a page: contents, style, script and what a browser may load.

pub(crate) mod page;
pub(crate) mod render;
pub(crate) mod script;
pub(crate) mod style;
