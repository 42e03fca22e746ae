use std::path::PathBuf;

use crate::scene::{Listener, SceneRole};

/// Consecutive rows of a run.
#[derive(Debug, Clone, Copy)]
pub struct RowBlock<'a> {
    /// Times (s), increasing within a block and from block to block.
    pub time_s: &'a [f64],
    /// Per arm, row-major positions of all joints (rad or m); a row with a NaN hides the arm until
    /// a row without one.
    pub arms: &'a [&'a [f64]],
    /// Per signal, row-major numbers of all joints; a NaN leaves a gap in the line.
    pub signals: &'a [&'a [f64]],
}

/// One bar for each joint.
#[derive(Debug, Clone, Copy)]
pub struct BarSeries<'a> {
    /// Name in the legend.
    pub name: &'a str,
    /// Decides the colour: that of its lines.
    pub role: SceneRole,
    /// One number a joint.
    pub values: &'a [f64],
}

/// A finished recording.
#[derive(Debug, Clone, PartialEq)]
pub struct FinishedRecording {
    /// The file.
    pub path: PathBuf,
    /// Rows taken.
    pub rows: u64,
    /// Size of the file (bytes).
    pub bytes: u64,
    /// Who watched.
    pub listener: Listener,
}
