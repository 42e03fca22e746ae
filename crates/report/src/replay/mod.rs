//! How far a simulation is from recorded motion and torque.

pub(crate) mod page;
pub(crate) mod replay_report;
#[cfg(test)]
pub(crate) mod sample;
