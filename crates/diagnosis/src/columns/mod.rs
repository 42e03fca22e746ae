//! The regression problem: the columns of every hypothesis about a robot, and the effort that they explain.
//!
//! ```text
//! effort - nominal effort = sum over hypotheses of columns weights + noise
//! ```

pub(crate) mod common;
pub(crate) mod common_columns;
pub(crate) mod design;
pub(crate) mod evaluated;
pub(crate) mod late_goals;
pub(crate) mod linear_rest;
pub(crate) mod prior;
pub(crate) mod readings;
pub(crate) mod repeats;
pub(crate) mod run_design;
pub(crate) mod shapes;
pub(crate) mod springs;
pub(crate) mod stratum;
