//! The claims of a paper, judged by numbers.

pub(crate) mod claim;
pub(crate) mod paper_models;
pub(crate) mod tracking_claims;
