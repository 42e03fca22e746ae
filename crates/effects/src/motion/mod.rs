//! What a cause needs of the signals: the motion of a run, and what the robot as described expects of it.

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
