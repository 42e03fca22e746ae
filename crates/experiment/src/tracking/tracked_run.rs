use std::path::PathBuf;

use recording::Listener;
use tracking::{Tracking, TrackingMetrics};

use crate::scenario::feedforward_kind::FeedforwardKind;

/// One motion tracked with one feedforward.
#[derive(Debug, Clone, PartialEq)]
pub struct TrackedRun {
    /// What was fed forward.
    pub kind: FeedforwardKind,
    /// Time that one prediction takes here, for all joints (s).
    pub prediction_time_s: f64,
    /// Every tick, and how it ended.
    pub tracking: Tracking,
    /// How well the arm followed.
    pub metrics: TrackingMetrics,
    /// The files that were written.
    pub written: Option<Written>,
}

/// The files of a run.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Written {
    /// The log: one Parquet file, or where that could not be written the CSV file that grew.
    pub log: PathBuf,
    /// The recording, where one is asked for.
    pub recording: Option<PathBuf>,
    /// Who saw the recording while it was written.
    pub listener: Listener,
    /// What could not be written, in sentences that name the file; the run went on.
    pub problems: Vec<String>,
}
