//! Models of the torque, learned from logs.
//!
//! ```text
//! tau_k = phi_k(q, qd, qdd)' beta + f_k(x) + noise,   x = (q, qd, qdd),   f_k ~ GP(0, k_k)
//! ```
//!
//! for joint `k`: rigid bodies (`f = 0`), a Gaussian process (`beta = 0`), and the ways of
//! having both that Nguyen-Tuong & Peters 2010 compare.

mod error;
mod regression;
mod samples;

pub use error::LearnerError;
pub use samples::{RunSpan, Samples, State};
