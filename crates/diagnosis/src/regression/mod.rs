//! Weights of a model from normal equations by block: their evidence, what they predict of held-out
//! blocks, physically possible sizes about the robot that has them, and how well these are known.

pub(crate) mod blocks;
pub(crate) mod extended;
pub(crate) mod fit;
pub(crate) mod fitted;
pub(crate) mod gram;
pub(crate) mod noise;
pub(crate) mod problem;
pub(crate) mod settle;
pub(crate) mod solved;
pub(crate) mod uncertainty;
