//! One trial: the answers of a diagnosis and of plain least squares, judged by the truth.

pub(crate) mod answers;
pub(crate) mod dry_friction;
pub(crate) mod judged_body;
pub(crate) mod judged_cause;
pub(crate) mod judged_finding;
pub(crate) mod judged_reasons;
pub(crate) mod judged_spoiling;
pub(crate) mod judgement;
pub(crate) mod panel_side;
pub(crate) mod peak_memory;
pub(crate) mod place;
pub(crate) mod population_trial;
pub(crate) mod prediction;
pub(crate) mod spoiling_phrases;
