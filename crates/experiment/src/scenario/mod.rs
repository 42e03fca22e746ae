//! What a tracking scenario says: the arm, the motion, the gains and what is fed forward.

pub(crate) mod feedforward_kind;
pub(crate) mod tracking_scenario;
pub(crate) mod tracking_spec;
