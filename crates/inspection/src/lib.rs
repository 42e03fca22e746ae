#![doc = include_str!("../README.md")]

mod clock;
mod fit;
mod frozen;
mod inspect;
mod judge;
mod jumps;
mod limits;
mod mend;
mod moments;
mod observation;
mod overlaps;
mod payload;
mod pieces;
mod pooled;
mod reading;
mod readings;
mod samples;
mod scale;
mod sentence;
mod shift;
mod spikes;
mod stranger;
#[cfg(test)]
mod testing;
mod thresholds;
mod torque;

pub use inspect::{inspect, inspect_with};
pub use mend::{Mended, mended};
pub use observation::{Evidence, Observation, ObservationKind, Rival, Spoils, Stretch};
pub use thresholds::Thresholds;
