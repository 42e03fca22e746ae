use experiment::Estimated;
use serde::Serialize;

use crate::statistics::median::median;
use crate::statistics::share::Share;

/// Errors of estimates, where their effects were named at their places.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SizeTally {
    /// Number of estimates.
    pub estimates: usize,
    /// Number of those that the logs determine; the fields below are of these.
    pub determined: usize,
    /// Median relative error.
    pub median_error: Option<f64>,
    /// Intervals that contain the injected value: 95 of 100 where they are calibrated.
    pub covered: Share,
}

impl SizeTally {
    /// The tally of some estimates.
    pub(super) fn new(estimates: &[&Estimated]) -> Self {
        let determined: Vec<_> = estimates.iter().filter(|e| e.determined).collect();
        Self {
            estimates: estimates.len(),
            determined: determined.len(),
            median_error: median(determined.iter().filter_map(|e| e.relative_error).collect()),
            covered: Share::of(&determined, |e| e.covers),
        }
    }
}
