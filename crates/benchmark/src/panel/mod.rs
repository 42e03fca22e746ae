//! Trials of a population: the answers of a diagnosis and of baselines, judged by the truth.

pub(crate) mod answers;
pub(crate) mod dry_friction;
pub(crate) mod judged_cause;
pub(crate) mod judged_finding;
pub(crate) mod judgement;
pub(crate) mod panel_side;
pub(crate) mod peak_memory;
pub(crate) mod place;
pub(crate) mod population_trial;
pub(crate) mod prediction;
