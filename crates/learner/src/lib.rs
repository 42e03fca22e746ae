//! Models of the torque, learned from logs.
//!
//! ```text
//! tau_k = phi_k(q, qd, qdd)' beta + f_k(x) + noise,   x = (q, qd, qdd),   f_k ~ GP(0, k_k)
//! ```
//!
//! for joint `k`: rigid bodies (`f = 0`), a Gaussian process (`beta = 0`), and the ways of
//! having both that Nguyen-Tuong & Peters 2010 compare.

mod block_sums;
mod error;
mod exact;
mod inducing;
mod inputs;
mod joint_kernel;
mod kernels;
mod memory;
mod model;
mod model_file;
mod model_kind;
mod nominal_parameter;
#[cfg(test)]
mod planar;
mod prior;
mod progress;
mod regression;
mod rigid_body_fit;
mod robot_torque;
mod sample_file;
mod sample_source;
mod samples;
mod saved;
mod score;
mod settings;
mod spread;
mod torque_model;
mod training;
mod undetermined;
mod weighting;

pub use error::LearnerError;
pub use inputs::ProcessInputs;
pub use memory::available_bytes;
pub use model::{Mean, Model, Process};
pub use model_kind::ModelKind;
pub use prior::GaussianPrior;
pub use progress::{SilentTraining, TrainingProgress};
pub use regression::Regression;
pub use rigid_body_fit::{ConsistentRigidBodies, RigidBodyFit};
pub use robot_torque::RobotTorque;
pub use sample_file::{SampleFile, SampleWriter};
pub use sample_source::SampleSource;
pub use samples::{RunSpan, SampleSlices, SampleState, Samples};
pub use score::TorqueScore;
pub use settings::{PriorSpread, TrainSettings};
pub use spread::Spread;
pub use torque_model::{TorqueModel, TorqueWorkspace};
pub use training::{JointFit, TrainedModel, Training};
pub use undetermined::Direction;
pub use weighting::{FitNoise, Weighting};
