//! The time of one prediction against the number of training points, for any robot.

pub mod curves;
pub mod measure;
mod peers;
mod regressor_kernel;
