//! The answer: findings with sizes and rivals, reasons against other effects, the gain on held-out data, the rest,
//! and the verdict of every joint.

pub(crate) mod assemble;
pub(crate) mod effect_at;
pub(crate) mod finding_builder;
pub(crate) mod findings;
pub(crate) mod gain;
pub(crate) mod held_out;
pub(crate) mod hold;
pub(crate) mod limit_finding;
pub(crate) mod prediction;
pub(crate) mod refusal_words;
pub(crate) mod ruled_out;
pub(crate) mod second_encoder;
pub(crate) mod size;
pub(crate) mod spectrum;
pub(crate) mod structure;
pub(crate) mod supplement;
pub(crate) mod tested_findings;
pub(crate) mod tone_finding;
pub(crate) mod torque_noise;
pub(crate) mod traces;
pub(crate) mod unnamed;
pub(crate) mod verdict;
