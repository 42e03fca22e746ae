//! The dynamics of a tree of rigid bodies, as the equation every other crate relies on:
//!
//! ```text
//! tau = M(q) qdd + C(q, qd) qd + g(q) = Y(q, qd, qdd) pi
//! ```
//!
//! [`Dynamics`] is made once from a [`robot::Robot`]; its methods come in two forms, one
//! that checks its input and allocates the result, one ending in `_into` for loops.

mod base_parameters;
mod cholesky;
mod columns;
mod consistency;
mod crba;
mod error;
mod forward;
mod least_squares;
mod model;
mod regressor;
mod rnea;
mod rotor;
mod spatial;

pub use base_parameters::{BaseParameters, base_parameters};
pub use columns::{Column, ColumnSet};
pub use consistency::{ConsistentFit, ConsistentInertias, FitOutcome, ShiftedPrior};
pub use error::DynamicsError;
pub use least_squares::NormalEquations;
pub use model::{Dynamics, Workspace};
pub use regressor::PARAMETERS_PER_LINK;
pub use rotor::Rotors;
