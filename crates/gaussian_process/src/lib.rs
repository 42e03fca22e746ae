//! Gaussian processes on plain arrays, as the equation that every model here is a case of:
//!
//! ```text
//! y = phi(x)' beta + f(x) + noise,   beta ~ N(beta_0, B),   f ~ GP(0, k),   noise ~ N(0, sigma_n²)
//! ```
//!
//! with the Gaussian kernel `k` of one width per input ([`GaussianKernel`]). Points are
//! row-major, one row of inputs each; targets are one number each. Nothing here knows of robots.

mod error;
mod exp;
mod inducing;
mod kernel;
mod kernel_sum;
mod likelihood;
mod linear_evidence;
mod maximise;
mod packed;
mod sweep;

pub use error::GpError;
pub use kernel::GaussianKernel;
pub use linear_evidence::{LinearEvidence, LinearPosterior, WhiteSums};
pub use maximise::{Maximum, Objective, SearchEnd, Watch, maximise};
