//! What is found beside the regression: lines of the spectrum over time and over position, and
//! limits of the efforts.

pub(crate) mod heard;
pub(crate) mod limits;
pub(crate) mod tone_fit;
pub(crate) mod tones;
