//! Gaussian processes on plain arrays, as the equation that every model here is a case of:
//!
//! ```text
//! y = phi(x)' beta + f(x) + noise,   beta ~ N(beta_0, B),   f ~ GP(0, k),   noise ~ N(0, sigma_n²)
//! ```
//!
//! with the Gaussian kernel `k` of one width per input ([`GaussianKernel`]). Points are
//! row-major, one row of inputs each; targets are one number each. Nothing here knows of robots.

mod cholesky;
mod covariance;
mod error;
mod exp;
mod gram;
mod inducing;
mod inducing_posterior;
mod inverse;
mod kernel;
mod kernel_search;
mod kernel_sum;
mod likelihood;
mod linear_evidence;
mod maximise;
mod packed;
mod panels;
mod pivoted_cholesky;
mod product;
mod residual;
mod sweep;
mod tile;

pub use error::GpError;
pub use inducing::Inducing;
pub use inducing_posterior::InducingPosterior;
pub use inverse::Inverse;
pub use kernel::GaussianKernel;
pub use kernel_search::{KernelSearch, LearnedKernel};
pub use kernel_sum::KernelSum;
pub use likelihood::{Covariance, Likelihood, LikelihoodValue};
pub use linear_evidence::{LinearEvidence, LinearPosterior, WhiteSums};
pub use maximise::{Maximum, Objective, SearchEnd, SearchWatch, maximise};
pub use pivoted_cholesky::{inducing_points, shared_kernel};
pub use residual::{Linear, ResidualProcess};
