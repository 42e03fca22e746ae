//! The motion to run next: the one that tells rival causes apart, or determines a cause.
//!
//! ```text
//! D(motion) = min_w sum_j 1/noise_j  integral (columns_A w_A - columns_B,others w)_j^2 dt
//! ```
//!
//! is twice the log evidence that is expected against `B` where `A` is true (T-optimality,
//! Atkinson & Fedorov 1975), `noise` the variance of what is left of an effort times its
//! autocorrelation time. [`design`] fits both rivals to the logs that could not tell them apart,
//! and searches a motion within the robot's limits for which the smallest `D` of all pairs, each
//! taken both ways, is as large as can be. Before there are logs it supposes their sizes.
//!
//! A motion goes from rest to rest, slow and fast, short and long, and rests: what tells friction
//! of one kind from another is a change of pace.

mod aim;
mod design;
mod error;
mod information;
mod known;
mod limits;
mod motion_record;
mod search;
mod steps;
#[cfg(test)]
mod testing;
mod trial_shapes;

pub use aim::{Goal, Question};
pub use design::{
    DesignSettings, DesignedMotion, ExcitationDesign, Prospect, SEPARATING_NATS, design,
};
pub use error::NextMotionError;
pub use trial_shapes::with_trial_shapes;
