//! The motion of a run, and the signals that the robot as described predicts along it.

pub(crate) mod cable_loop;
pub(crate) mod compliance;
pub(crate) mod direction;
pub(crate) mod drive;
pub(crate) mod dry_friction;
pub(crate) mod effort_timing;
pub(crate) mod encoders;
pub(crate) mod frame;
pub(crate) mod rigid_bodies;
pub(crate) mod run_motion;
pub(crate) mod scale;
pub(crate) mod slopes;
pub(crate) mod transmission;
