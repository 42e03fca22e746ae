use std::f64::consts::PI;

use crate::LogError;

/// A zero-phase Butterworth low-pass, run forward and backward over a signal.
///
/// ```text
/// |H(f)|² = 1 / (1 + (tan(pi f / rate) / tan(pi cutoff / rate))^(2 order))
/// ```
///
/// is the gain of the two passes together: 1/2 at the cut-off, and a phase of zero. The
/// filter is a cascade of second-order sections by the bilinear transform. Before the
/// first sample and after the last the signal is continued by its odd reflection over
///
/// ```text
/// max(3 (order + 1), ceil(2 rate / cutoff)) samples, or all but one of a shorter signal
/// ```
///
/// and every pass begins in the steady state of its first sample: as in
/// `scipy.signal.sosfiltfilt` with that `padlen`, whose own choice is the first of the
/// two and too short for a low cut-off.
#[derive(Debug, Clone, PartialEq)]
pub struct LowPass {
    padding: usize,
    sections: Vec<Section>,
}

/// One section with a gain of 1 at frequency zero:
/// `y = (b0 + b1 z^-1 + b2 z^-2) / (1 + a1 z^-1 + a2 z^-2) x`.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Section {
    b: [f64; 3],
    a: [f64; 2],
}

impl LowPass {
    /// The highest order that can be made.
    pub const HIGHEST_ORDER: usize = 12;

    /// A filter of `order` (of one pass) with the given cut-off and sampling rate (Hz).
    ///
    /// # Errors
    ///
    /// [`LogError::FilterOrder`] unless the order is 1 to [`Self::HIGHEST_ORDER`], and
    /// [`LogError::CutoffOutOfRange`] unless the cut-off is between 0 and half the rate.
    pub fn new(order: usize, cutoff_hz: f64, rate_hz: f64) -> Result<Self, LogError> {
        if order == 0 || order > Self::HIGHEST_ORDER {
            return Err(LogError::FilterOrder { found: order, highest: Self::HIGHEST_ORDER });
        }
        let nyquist_hz = 0.5 * rate_hz;
        if !(cutoff_hz > 0.0 && cutoff_hz < nyquist_hz) {
            return Err(LogError::CutoffOutOfRange { found_hz: cutoff_hz, nyquist_hz });
        }
        let warped = (PI * cutoff_hz / rate_hz).tan();
        let mut sections = Vec::new();
        for pair in 0..order / 2 {
            // Poles of the analogue filter at angles pi (2 k + 1) / (2 order) from the axis.
            let angle = PI * (2 * pair + 1) as f64 / (2 * order) as f64;
            sections.push(Section::second_order(warped, 2.0 * angle.sin()));
        }
        if order % 2 == 1 {
            sections.push(Section::first_order(warped));
        }
        let padding = (3 * (order + 1)).max((2.0 * rate_hz / cutoff_hz).ceil() as usize);
        Ok(Self { padding, sections })
    }

    /// Filters a signal in place, forward and backward.
    pub fn apply(&self, x: &mut [f64]) {
        let Some(last) = x.len().checked_sub(1) else { return };
        let pad = self.padding.min(last);
        let before = (1..=pad).rev().map(|k| 2.0 * x[0] - x[k]);
        let after = (1..=pad).map(|k| 2.0 * x[last] - x[last - k]);
        let mut padded: Vec<f64> = before.chain(x.iter().copied()).chain(after).collect();
        for section in &self.sections {
            section.run(padded.iter_mut());
        }
        for section in &self.sections {
            section.run(padded.iter_mut().rev());
        }
        x.copy_from_slice(&padded[pad..pad + x.len()]);
    }
}

impl Section {
    /// `w² / (s² + damping w s + w²)` with `s = (1 - z^-1) / (1 + z^-1)`.
    fn second_order(w: f64, damping: f64) -> Self {
        let norm = 1.0 / (1.0 + damping * w + w * w);
        let b0 = w * w * norm;
        let a = [2.0 * (w * w - 1.0) * norm, (1.0 - damping * w + w * w) * norm];
        Self { b: [b0, 2.0 * b0, b0], a }
    }

    /// `w / (s + w)` with `s = (1 - z^-1) / (1 + z^-1)`.
    fn first_order(w: f64) -> Self {
        let b0 = w / (1.0 + w);
        Self { b: [b0, b0, 0.0], a: [(w - 1.0) / (w + 1.0), 0.0] }
    }

    /// One pass, transposed direct form II, from the steady state of the first sample.
    fn run<'a>(&self, samples: impl Iterator<Item = &'a mut f64>) {
        let ([b0, b1, b2], [a1, a2]) = (self.b, self.a);
        let mut state: Option<(f64, f64)> = None;
        for sample in samples {
            let x = *sample;
            let (z1, z2) = state.unwrap_or(((1.0 - b0) * x, (b2 - a2) * x));
            let y = b0 * x + z1;
            state = Some((b1 * x - a1 * y + z2, b2 * x - a2 * y));
            *sample = y;
        }
    }
}

/// Every `factor`-th sample, from the first; a factor of 0 counts as 1.
///
/// What lies above half the new rate folds back: apply a [`LowPass`] before.
pub fn decimate(x: &[f64], factor: usize) -> Vec<f64> {
    x.iter().copied().step_by(factor.max(1)).collect()
}
