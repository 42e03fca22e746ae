use std::ops::Range;

use logs::LowPass;

/// Order of the low-pass of a band in which a tone is compared with the rest.
const ORDER: usize = 4;

/// The part of a signal below a cut-off.
pub(crate) fn low_pass(x: &[f64], time: &[f64], cutoff_hz: f64) -> Vec<f64> {
    let span = time.last().zip(time.first()).map_or(0.0, |(last, first)| last - first);
    let rate_hz = time.len().saturating_sub(1) as f64 / span;
    let mut slow = x.to_vec();
    // At a rate that is too low for the filter the signal has nothing above the cut-off.
    if let Ok(filter) = LowPass::new(ORDER, cutoff_hz, rate_hz) {
        filter.apply(&mut slow);
    }
    slow
}

/// Parts of a run of about `window_s`.
pub(crate) fn windows(time: &[f64], window_s: f64) -> Vec<Range<usize>> {
    let span = time.last().zip(time.first()).map_or(0.0, |(last, first)| last - first);
    let count = ((span / window_s) as usize).max(1);
    (0..count).map(|i| i * time.len() / count..(i + 1) * time.len() / count).collect()
}
