//! The model side of every effect: the columns that explain it in a log, what its
//! weights mean, and its place in the robot's description.
//!
//! ```text
//! effort - nominal effort = sum over hypotheses of columns(motion) weights + noise
//! ```
//!
//! One file an effect, under the name it has in `catalogue`; [`model`] finds it.

mod asymmetric_friction;
mod cable_spring;
mod coulomb_friction;
mod explain;
mod gravity_direction;
mod hypothesis;
mod inertial_parameters;
mod motion;
mod payload;
mod rotor_inertia;
mod scale;
mod torque_constant;
mod torque_offset;
mod viscous_friction;

pub use explain::{Column, Explain, Part, Quantity, model};
pub use hypothesis::{Hypothesis, Place, hypotheses};
pub use motion::{Frame, Motion};
pub use scale::Scale;
