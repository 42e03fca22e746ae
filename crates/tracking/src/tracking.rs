use robot::MachineFault;

use crate::rows::TrackingRows;
use crate::timing::Timing;
use crate::watch::Event;

/// A run: the reference, the response, and how it ended.
#[derive(Debug, Clone, PartialEq)]
pub struct Tracking {
    /// Time from one tick to the next (s).
    pub period_s: f64,
    /// The feedforward, in words.
    pub feedforward: String,
    /// Every tick.
    pub rows: TrackingRows,
    /// What happened.
    pub events: Vec<Event>,
    /// How well the predictions and the ticks kept their time.
    pub timing: Timing,
    /// How it ended.
    pub end: End,
}

/// How a run ended.
#[derive(Debug, Clone, PartialEq)]
pub enum End {
    /// With the motion.
    Complete,
    /// The machine stopped, or reported what nothing can be controlled by.
    Fault(MachineFault),
    /// The watch ended it.
    Stopped,
}
