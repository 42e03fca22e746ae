//! The model side of the effects: the columns that explain it in a log, what its
//! weights mean, and its place in the robot's description.
//!
//! ```text
//! effort - nominal effort = sum over hypotheses of columns(motion) weights + noise
//! ```
//!
//! The README of this crate says how an effect is added. One file an effect, under the name it has in `catalogue` (delay and lag are `late_torque`);
//! [`model`] finds it, or says what an effect without one would need. [`Compensation`] asks the
//! motors for what undoes the effects that a robot's description holds, and [`remedy`] says
//! which those are.

mod asymmetric_friction;
mod backlash;
mod cable_loop;
mod cable_spring;
mod compensation;
mod coulomb_friction;
mod counterbalance;
mod differential_coupling;
mod direction;
mod dry_friction;
mod encoder_offset;
mod explain;
mod friction_temperature_drift;
mod germ;
mod give;
mod gravity_direction;
mod hypothesis;
mod inertial_parameters;
mod joint_elasticity;
mod late_torque;
mod left_out;
mod load_dependent_friction;
mod model;
mod motion;
mod nature;
mod payload;
mod position_dependent_friction;
mod presliding_friction;
mod remedy;
mod rigid_bodies;
mod rotor_inertia;
mod scale;
mod slopes;
mod stribeck_friction;
mod time_skew;
mod timing;
mod torque_constant;
mod torque_offset;
mod transmission;
mod transmission_ratio;
mod viscous_friction;

pub use compensation::{Compensated, Compensation, CompensationWorkspace};
pub use explain::{Column, Explain, Part, Quantity};
pub use germ::{Germ, germs, weeded};
pub use hypothesis::{Hypothesis, Place, hypotheses};
pub use left_out::left_out;
pub use model::{MODELLED, model};
pub use motion::{Encoders, Frame, Motion, drive_torque};
pub use nature::{Law, Linearity, Nature, Relation, Seat, Shows, Weights};
pub use remedy::remedy;
pub use scale::Scale;
