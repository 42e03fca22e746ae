//! A diagnosis: as a page, a figure, a text, a cell of a notebook, Markdown and JSON.

pub(crate) mod estimate;
pub(crate) mod figure;
pub(crate) mod forward;
pub(crate) mod input_options;
pub(crate) mod joint_charts;
pub(crate) mod json;
pub(crate) mod markdown;
pub(crate) mod notebook;
pub(crate) mod page;
pub(crate) mod places;
pub(crate) mod report;
pub(crate) mod residual;
pub(crate) mod sections;
pub(crate) mod sentence;
pub(crate) mod spectra;
pub(crate) mod tables;
pub(crate) mod text;
