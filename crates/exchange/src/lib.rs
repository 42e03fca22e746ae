//! A robot in the files of other programs.
//!
//! ```text
//! Loaded (robot.urdf + robot.toml) -> export -> text of a URDF, an MJCF, an SDF or a USD layer
//!                                           |-> fates: exact, approximated, dropped
//!                                           \-> the robot that the file describes
//! ```
//!
//! [`export`] writes what a format can hold, says of every quantity what became of it, and gives the robot that is
//! left of it, whose torque tells the loss.

mod error;
mod export;
mod fate;
mod held;
mod inertial;
mod mjcf;
mod mjcf_joint;
mod numbers;
mod quantity;
mod reported;
mod sdf;
mod sheet;
mod urdf;
mod urdf_joint;
mod urdf_written;
mod usd_text;
mod usda;
mod usda_joint;

pub use error::ExchangeError;
pub use export::{Export, Format, export};
pub use fate::{Fate, Fated};
