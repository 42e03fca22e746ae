//! CauseBench: trials without their truth for the methods of anyone, and the scores of their answers.

pub(crate) mod answer;
pub(crate) mod answer_fault;
pub(crate) mod bench_set;
pub(crate) mod bench_truth;
pub(crate) mod board;
pub(crate) mod export;
pub(crate) mod judged_answers;
pub(crate) mod manifest;
pub(crate) mod name_match;
pub(crate) mod prediction_error;
pub(crate) mod replay_drift;
pub(crate) mod score_row;
pub(crate) mod score_text;
pub(crate) mod scores;
pub(crate) mod spoken;
pub(crate) mod table_file;
