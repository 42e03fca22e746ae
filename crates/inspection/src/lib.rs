#![doc = include_str!("../README.md")]

mod another_robot;
mod clock;
mod clocks_of_runs;
mod effort_shift;
mod effort_unit;
mod fit;
mod frozen;
mod goal_velocity;
mod inspect;
mod judge;
mod jumps;
mod limits;
mod locked;
mod log_reading;
mod mend;
mod moments;
mod motion_samples;
mod nominal_torque;
mod normalised;
mod observation;
mod overlaps;
mod payload;
mod pieces;
mod pooled;
mod readings;
mod scale;
mod sentence;
mod spikes;
#[cfg(test)]
mod testing;
mod thresholds;
mod zeros;

pub use inspect::{inspect, inspect_with};
pub use mend::{CorrectedLogs, correct, correct_with};
pub use observation::{
    CountedTogether, JointUnit, Observation, ObservationKind, OtherLock, ReadingEvidence, Rival,
    RunStretch, RunZero, Spoils,
};
pub use thresholds::{InspectionThresholds, MomentThresholds};
