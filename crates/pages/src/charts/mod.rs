//! Drawings as SVG: curves over linear axes, dots over a logarithmic one, titles and legends.

pub(crate) mod chart;
pub(crate) mod decimate;
pub(crate) mod dots;
pub(crate) mod inks;
pub(crate) mod linear_axis;
pub(crate) mod log_axis;
pub(crate) mod plot;
pub(crate) mod sheet;
