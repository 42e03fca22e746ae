//! A robot in the files of other programs.
//!
//! ```text
//! Loaded (robot.urdf + robot.toml) -> export -> text of a URDF, an MJCF, an SDF or a USD layer
//!                                           |-> fates: exact, approximated, dropped
//!                                           \-> the robot that the file describes
//! ```
//!
//! [`export`] writes what a format can hold, states the fate of every quantity, and returns the robot that the file
//! describes. The torques of both robots show the loss.

mod error;
mod export;
mod fate;
mod fates;
mod format;
mod mjcf;
mod numbers;
mod quantity;
mod reported;
mod robot_in_file;
mod sdf;
mod unsupported;
mod urdf;
mod usd;
mod xml_text;

pub use error::ExchangeError;
pub use export::{Export, export};
pub use fate::{Fate, QuantityFate};
pub use format::Format;
