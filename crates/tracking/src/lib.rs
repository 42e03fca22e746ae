//! Computed-torque tracking of a motion by any machine, with a feedforward that is predicted
//! beside the loop.
//!
//! ```text
//! u(t_k) = limit(u_FF(q_ref, qd_ref, qdd_ref) + kp error + kd error_rate),   error = q_ref - q
//! ```
//!
//! The feedback runs in every tick and never waits; of the feedforward the newest prediction is
//! used. What happens when predictions are late, wrong or stay away is in the crate's README.

mod controller;
mod error;
mod feedforward;
mod holding;
mod latest;
mod metrics;
mod model_feedforward;
mod named_feedforward;
mod pace;
mod predictor;
mod rows;
mod run;
mod settings;
#[cfg(test)]
mod testing;
mod timing;
mod tip;
mod torque_limits;
mod track;
mod tracking;
mod trust;
mod wall;
mod watch;

pub use controller::{Controller, ErrorRate};
pub use error::TrackingError;
pub use feedforward::{Feedforward, NoFeedforward, TorquePrediction};
pub use holding::holds;
pub use metrics::{Distance, JointMetrics, LinkMetrics, TrackingMetrics};
pub use model_feedforward::{GravityFeedforward, ModelFeedforward};
pub use named_feedforward::NamedFeedforward;
pub use rows::{Signal, TrackingRows};
pub use settings::{Ahead, RunClock, TrackingSettings, VirtualClock, WallClock};
pub use timing::{Latency, Timing, WallClockTiming};
pub use tip::tip_in_base;
pub use torque_limits::TorqueLimits;
pub use track::track;
pub use tracking::{End, Tracking};
pub use watch::{ControlTick, Event, Level, TrackingWatch};
