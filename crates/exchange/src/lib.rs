//! A robot in the files of other programs.
//!
//! ```text
//! Loaded (robot.urdf + robot.toml) -> export -> text of a URDF, an MJCF, an SDF or a USD layer
//!                                           |-> fates: exact, approximated, dropped
//!                                           \-> the robot that the file describes
//! ```
//!
//! Of a robot with position loops, the servos alone can be written as well: for a model of MuJoCo, for Isaac Lab, and as
//! parameters of BAM.
//!
//! [`export`] writes what a format can hold, states the fate of every quantity, and returns the robot that the file
//! describes. The torques of both robots show the loss.

mod actuator;
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
mod servo;
mod unsupported;
mod urdf;
mod usd;
mod xml_text;

pub use error::ExchangeError;
pub use export::{Export, export};
pub use fate::{Fate, QuantityFate};
pub use format::Format;
