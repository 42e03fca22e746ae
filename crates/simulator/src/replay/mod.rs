//! Recorded logs against a simulation: rolled forward under their torques, or followed along their motion.

pub(crate) mod forward;
pub(crate) mod motion;
pub(crate) mod record;
