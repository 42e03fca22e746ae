//! What is told: findings with sizes and rivals, what was ruled out, the gain on held-out data, what is
//! left and the verdict of every joint.

pub(crate) mod answer;
pub(crate) mod between;
pub(crate) mod effect_at;
pub(crate) mod findings;
pub(crate) mod gain;
pub(crate) mod held_out;
pub(crate) mod hold;
pub(crate) mod limit_finding;
pub(crate) mod prediction;
pub(crate) mod report;
pub(crate) mod ruled_out;
pub(crate) mod size;
pub(crate) mod spectrum;
pub(crate) mod structure;
pub(crate) mod told;
pub(crate) mod tone_finding;
pub(crate) mod torque_noise;
pub(crate) mod traces;
pub(crate) mod unnamed;
pub(crate) mod verdict;
