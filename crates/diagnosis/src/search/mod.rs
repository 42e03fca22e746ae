//! Which hypotheses the logs support: by evidence and held-out prediction, with one size that holds for all logs.

pub(crate) mod accept;
pub(crate) mod admit;
pub(crate) mod causes;
pub(crate) mod change;
pub(crate) mod common_of_logs;
pub(crate) mod constancy;
pub(crate) mod dataset;
pub(crate) mod friction_error;
pub(crate) mod inputs;
pub(crate) mod kept_nominal;
pub(crate) mod ledger;
pub(crate) mod model_state;
pub(crate) mod moves;
pub(crate) mod paired_difference;
pub(crate) mod refusal;
pub(crate) mod refusals;
pub(crate) mod rivals;
pub(crate) mod rules;
pub(crate) mod search_result;
pub(crate) mod select;
pub(crate) mod select_model;
pub(crate) mod size_rules;
pub(crate) mod start;
pub(crate) mod twins;
