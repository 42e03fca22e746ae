//! What an oracle that knows the true model, the motion and the sensors sees of each cause: a Cramer-Rao
//! bound on its size, everything else unknown.

mod column;
mod motion;
mod noise;
mod regression;
mod stand_ins;

pub(crate) use column::{Column, StandIn};
pub(crate) use motion::SeenRun;
pub use noise::JointNoise;
pub(crate) use regression::{effort_rms, strengths};
pub(crate) use stand_ins::{dry, stand_ins};
