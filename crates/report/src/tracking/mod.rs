//! What models of the torque are worth as feedforward: runs that follow one motion side by side.

mod comparison;
mod error_chart;
mod keys;
mod motion_chart;
mod page;
#[cfg(test)]
pub(crate) mod sample;
mod sentence;
mod sweep_chart;
mod table;

pub use comparison::{
    FirstSeconds, Gains, Sweep, SweptModel, TRACKING_SCHEMA, TrackedModel, TrackingComparison,
    WallTiming,
};
