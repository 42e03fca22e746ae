//! What an oracle that knows the true model, the motion and the sensors sees of each cause: a Cramer-Rao
//! bound on its size, everything else unknown.

pub(crate) mod along;
#[cfg(test)]
mod closed_forms;
pub(crate) mod column;
pub(crate) mod command_noise;
pub(crate) mod motion;
pub(crate) mod noise;
pub(crate) mod regression;
pub(crate) mod runs;
pub(crate) mod scales;
pub(crate) mod stand_ins;
