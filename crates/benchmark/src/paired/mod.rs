//! Two results of the same trials, compared trial by trial.

pub(crate) mod comparison;
pub(crate) mod comparison_text;
pub(crate) mod measures;
pub(crate) mod paired_mean;
pub(crate) mod paired_share;
pub(crate) mod turned;
