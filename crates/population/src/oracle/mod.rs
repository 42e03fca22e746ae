//! What an oracle that knows the true model, the motion and the sensors sees of each cause: a Cramer-Rao
//! bound on its size, everything else unknown.

pub(crate) mod column;
pub(crate) mod motion;
pub(crate) mod noise;
pub(crate) mod regression;
pub(crate) mod stand_ins;

pub(crate) use column::{Column, StandIn};
pub(crate) use motion::SeenRun;
pub use noise::JointNoise;
pub(crate) use regression::{effort_rms, strengths};
pub(crate) use stand_ins::{dry, stand_ins};
