//! What a campaign or a figure came to: pages, drawings, text, JSON.

pub(crate) mod paper;
#[cfg(test)]
pub(crate) mod sample;
pub(crate) mod times;
pub(crate) mod trials;
