//! The dynamics of a tree of rigid bodies, as the equation every other crate relies on:
//!
//! ```text
//! tau = M(q) qdd + C(q, qd) qd + g(q) = Y(q, qd, qdd) pi
//! ```
//!
//! [`Dynamics`] is made once from a [`robot::Robot`]; its methods come in two forms, one
//! that checks its input and allocates the result, one ending in `_into` for loops.
//!
//! A point of 2 kg held level, 0.5 m from a horizontal hinge, needs
//! `m g l = 2 x 9.81 x 0.5 = 9.81` N·m:
//!
//! ```
//! let pendulum = robot::Robot::from_urdf(r#"<robot name="pendulum">
//!   <link name="base"/>
//!   <link name="arm"><inertial><origin xyz="0.5 0 0"/><mass value="2"/>
//!     <inertia ixx="0.001" ixy="0" ixz="0" iyy="0.001" iyz="0" izz="0.001"/></inertial></link>
//!   <joint name="hinge" type="continuous"><parent link="base"/><child link="arm"/>
//!     <axis xyz="0 -1 0"/></joint>
//! </robot>"#)?;
//! let tau = dynamics::Dynamics::new(&pendulum).inverse_dynamics(&[0.0], &[0.0], &[0.0])?;
//! assert!((tau[0] - 9.81).abs() < 1e-12);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! Names, signs and frames are those of the map of the workspace, which follows.
#![doc = include_str!("../../README.md")]

mod base_parameters;
mod cholesky;
mod columns;
mod consistency;
mod crba;
mod derivatives;
mod error;
mod forward;
mod gram;
mod least_squares;
mod link_in_base;
mod model;
mod regressor;
mod rnea;
mod rotor;
mod spatial;

pub use base_parameters::{BaseParameters, base_parameter_count, base_parameters};
pub use columns::{ColumnSet, RegressorColumn};
pub use consistency::{ConsistentFit, ConsistentInertias, FitOutcome, ShiftedPrior};
pub use derivatives::InverseDynamicsDerivatives;
pub use error::DynamicsError;
pub use gram::add_gram;
pub use least_squares::NormalEquations;
pub use model::{Dynamics, Workspace};
pub use regressor::PARAMETERS_PER_LINK;
pub use rotor::Rotors;
