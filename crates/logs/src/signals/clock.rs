//! Resamples the clock of a file to a uniform one.

use std::ops::Range;

use crate::runs::run::median;

/// The longest gap that is filled by interpolation at any cut-off (samples).
const LONGEST_FILLED: usize = 5;
/// The longest gap that is filled, in periods of the cut-off. The motion is slow enough below the cut-off
/// for a cubic through both ends to follow it.
const FILLED_PERIODS: f64 = 0.25;

/// The longest gap that is filled by interpolation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Fill {
    /// Length of the gap (s).
    length_s: f64,
}

/// A piece of a run without a long gap, and the uniform clock at which it is sampled.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Piece {
    /// Rows of the run.
    pub rows: Range<usize>,
    /// Rate of the uniform clock (Hz).
    pub rate_hz: f64,
    /// Largest difference between a step and the usual step of the run (s).
    pub deviation_s: f64,
    /// Whether the clock of the rows is uniform already.
    pub is_uniform: bool,
}

impl Fill {
    /// Fills gaps of up to five samples.
    pub(crate) const SAMPLES: Self = Self { length_s: 0.0 };

    /// Fills gaps of up to five samples or a quarter period of the cut-off.
    pub(crate) fn below(cutoff_hz: f64) -> Self {
        Self { length_s: FILLED_PERIODS / cutoff_hz }
    }

    /// The longest gap that is filled in a run (s).
    pub(crate) fn longest_s(&self, time: &[f64]) -> f64 {
        let steps: Vec<f64> = time.windows(2).map(|t| t[1] - t[0]).collect();
        ((LONGEST_FILLED as f64 + 0.5) * median(&steps)).max(self.length_s)
    }
}

/// The pieces of a run between its long gaps.
pub(crate) fn pieces(time: &[f64], fill: Fill) -> Vec<Piece> {
    let steps: Vec<f64> = time.windows(2).map(|t| t[1] - t[0]).collect();
    let middle = median(&steps);
    // The mean of the steps that are no gaps: the median of steps with jitter is off.
    let regular = steps.iter().filter(|&&s| s <= 1.5 * middle);
    let usual = regular.clone().sum::<f64>() / regular.count().max(1) as f64;
    let longest = fill.longest_s(time);
    let mut pieces = Vec::new();
    let mut start = 0;
    for end in 1..=time.len() {
        if end == time.len() || steps[end - 1] > longest {
            pieces.push(piece(time, start..end, usual));
            start = end;
        }
    }
    pieces
}

fn piece(time: &[f64], rows: Range<usize>, usual: f64) -> Piece {
    let own = &time[rows.clone()];
    let spans = (own.len() - 1).max(1) as f64;
    let mean = (own[own.len() - 1] - own[0]) / spans;
    let deviation = |step: f64| {
        let off = |(k, t): (usize, &f64)| (t - own[0] - k as f64 * step).abs();
        own.iter().enumerate().map(off).fold(0.0, f64::max)
    };
    // A thousandth of a period is below what a file's digits and a clock keep.
    let is_uniform = mean > 0.0 && deviation(mean) <= 1e-3 * mean;
    let step = if is_uniform { mean } else { usual };
    let rate_hz = round_number(1.0 / step, if is_uniform { 1e-6 } else { 1e-3 });
    let deviation_s = own.windows(2).map(|t| (t[1] - t[0] - usual).abs()).fold(0.0, f64::max);
    Piece { rows, rate_hz, deviation_s, is_uniform }
}

/// The number with the fewest digits within a relative tolerance, up to six digits.
fn round_number(x: f64, tolerance: f64) -> f64 {
    let size = x.abs().log10().floor() as i32;
    (0..6)
        .map(|digits| {
            // Divided by a power of ten, not multiplied by its inverse: 0.1 is not exact.
            let (up, down) =
                (10f64.powi((digits - size).max(0)), 10f64.powi((size - digits).max(0)));
            (x * up / down).round() / up * down
        })
        .find(|rounded| (rounded - x).abs() <= tolerance * x.abs())
        .unwrap_or(x)
}

impl Piece {
    /// The uniform clock (s): the rows themselves, or steps of `1 / rate` from the first.
    pub(crate) fn clock(&self, time: &[f64]) -> Vec<f64> {
        let own = &time[self.rows.clone()];
        if self.is_uniform {
            return own.to_vec();
        }
        let (first, length) = (own[0], own[own.len() - 1] - own[0]);
        let count = (length * self.rate_hz + 1e-6).floor() as usize + 1;
        (0..count).map(|k| first + k as f64 / self.rate_hz).collect()
    }

    /// A signal at the uniform clock: as it is where the rows lie on it, else by [`interpolate`].
    pub(crate) fn resample(&self, time: &[f64], x: &[f64], clock: &[f64]) -> Vec<f64> {
        let (t, x) = (&time[self.rows.clone()], &x[self.rows.clone()]);
        if self.is_uniform || t.len() < 2 {
            return x.to_vec();
        }
        interpolate(t, x, clock)
    }
}

/// A signal of two or more rows at the times of a clock, by cubic Hermite interpolation:
///
/// ```text
/// x(t) = h00 x0 + h10 (t1 - t0) m0 + h01 x1 + h11 (t1 - t0) m1
/// ```
///
/// `m` is the slope of the parabola through a row and its two neighbours (Catmull-Rom on a
/// non-uniform clock). A neighbour is at least about a step away. Beside a filled gap a nearer neighbour
/// would turn one encoder count over one sample into a slope.
pub(crate) fn interpolate(t: &[f64], x: &[f64], clock: &[f64]) -> Vec<f64> {
    let mut k = 0;
    let mut at = |now: f64| {
        while k + 2 < t.len() && t[k + 1] <= now {
            k += 1;
        }
        let step = t[k + 1] - t[k];
        let s = ((now - t[k]) / step).clamp(0.0, 1.0);
        let (s2, s3) = (s * s, s * s * s);
        let [m0, m1] = slopes(t, x, k);
        (2.0 * s3 - 3.0 * s2 + 1.0) * x[k]
            + (s3 - 2.0 * s2 + s) * step * m0
            + (3.0 * s2 - 2.0 * s3) * x[k + 1]
            + (s3 - s2) * step * m1
    };
    clock.iter().map(|&now| at(now)).collect()
}

/// Slopes at both ends of the step from row `k` to the next.
fn slopes(t: &[f64], x: &[f64], k: usize) -> [f64; 2] {
    /// Least distance of a neighbour, as a share of the step.
    const AWAY: f64 = 0.7;
    let step = t[k + 1] - t[k];
    let before = (0..k).rev().find(|&j| t[k] - t[j] >= AWAY * step);
    let after = (k + 2..t.len()).find(|&j| t[j] - t[k + 1] >= AWAY * step);
    let secant = |a: usize, b: usize| (x[b] - x[a]) / (t[b] - t[a]);
    let through = |a: usize, middle: usize, b: usize| {
        let (before, after) = (t[middle] - t[a], t[b] - t[middle]);
        (secant(a, middle) * after + secant(middle, b) * before) / (before + after)
    };
    let alone = secant(k, k + 1);
    [before.map_or(alone, |j| through(j, k, k + 1)), after.map_or(alone, |j| through(k, k + 1, j))]
}
