use std::path::PathBuf;

use recording::Listener;
use tracking::{Tracking, TrackingMetrics};

use crate::scenario::feedforward_kind::FeedforwardKind;

/// One motion tracked with one feedforward.
#[derive(Debug, Clone, PartialEq)]
pub struct TrackedRun {
    /// The feedforward.
    pub kind: FeedforwardKind,
    /// Time of one prediction for all joints on this computer (s).
    pub prediction_time_s: f64,
    /// Every tick, and how the run ended.
    pub tracking: Tracking,
    /// The tracking errors.
    pub metrics: TrackingMetrics,
    /// The files that were written.
    pub written: Option<Written>,
}

/// The files of a run.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Written {
    /// The log: one Parquet file, or the growing CSV file where the Parquet file could not be written.
    pub log: PathBuf,
    /// The recording, if one was asked for.
    pub recording: Option<PathBuf>,
    /// The viewer that received the recording during the run.
    pub listener: Listener,
    /// Files that could not be written, each in a sentence that names the file; the run itself went on.
    pub problems: Vec<String>,
}
