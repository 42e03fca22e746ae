//! The content of a tracking scenario: the arm, the motion, the gains and the feedforward.

pub(crate) mod feedforward_kind;
pub(crate) mod tracking_scenario;
pub(crate) mod tracking_spec;
