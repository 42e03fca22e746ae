//! Motions drawn from a seed that an arm can follow.

pub(crate) mod by_joint;
pub(crate) mod draw;
pub(crate) mod ground;
pub(crate) mod log_plan;
pub(crate) mod postures;
