//! Results of a campaign or a figure as pages, drawings, text and JSON.

pub(crate) mod paper;
#[cfg(test)]
pub(crate) mod sample;
pub(crate) mod times;
pub(crate) mod trials;
