use logs::Prepared;
use realfft::RealFftPlanner;

use crate::design::{Design, RunDesign};
use crate::result::NoiseFloorSource;

/// Largest difference in position between two runs of one motion, as a share of the range.
const REPEAT_SHARE: f64 = 0.01;

/// Largest shift in time between two runs of one motion (s).
const REPEAT_SHIFT_S: f64 = 1.0;

/// Noise above the band begins at so many cut-offs.
const ABOVE_BAND: f64 = 3.0;

/// How near white noise must come to what a flexible predictor leaves to account for it.
const ACCOUNTS: f64 = 0.8;

/// Noise floors measured without any model: none where the logs do not allow it.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Floors {
    /// RMS difference of runs that repeat a motion, over `sqrt 2`, per joint (N·m or N).
    pub repeats: Option<Vec<f64>>,
    /// RMS in the band of white noise seen above it, per joint (N·m or N).
    pub white: Option<Vec<f64>>,
}

impl Floors {
    /// Measures both.
    pub fn new(design: &Design, prepared: &Prepared) -> Self {
        Self { repeats: repeats(design), white: white(prepared) }
    }

    /// The noise floor of joint `j`, given what a flexible predictor leaves there.
    pub fn choose(&self, j: usize, flexible: f64) -> (f64, NoiseFloorSource) {
        let repeats = self.repeats.as_ref().map(|r| r[j]).filter(|r| *r <= flexible);
        let white = self.white.as_ref().map(|w| w[j]).filter(|w| *w >= ACCOUNTS * flexible);
        match (repeats, white) {
            (Some(rms), _) => (rms, NoiseFloorSource::Repeats),
            (None, Some(rms)) => (rms.min(flexible), NoiseFloorSource::HighFrequencyBand),
            (None, None) => (flexible, NoiseFloorSource::FlexiblePredictor),
        }
    }
}

/// `sqrt(mean((r_a - r_b)^2) / 2)` over all pairs of runs that repeat a motion, `r` the
/// residual of the nominal model, so that small differences of the motion cancel.
fn repeats(design: &Design) -> Option<Vec<f64>> {
    let joints = design.joints();
    let (mut sum, mut count) = (vec![0.0; joints], 0_usize);
    for (a, first) in design.runs.iter().enumerate() {
        for second in &design.runs[a + 1..] {
            let Some(shift) = repeat_shift(design, first, second) else { continue };
            let pairs = overlap(first.time.len(), second.time.len(), shift);
            count += pairs.len();
            for (j, total) in sum.iter_mut().enumerate() {
                let of = |run: &RunDesign| run.joints[j].residual().collect::<Vec<_>>();
                let (x, y) = (of(first), of(second));
                *total += pairs.iter().map(|&(s, t)| (x[s] - y[t]).powi(2)).sum::<f64>();
            }
        }
    }
    (count > 0).then(|| sum.iter().map(|s| (0.5 * s / count as f64).sqrt()).collect())
}

/// The shift (samples) at which the second run repeats the first, if it does.
fn repeat_shift(design: &Design, first: &RunDesign, second: &RunDesign) -> Option<isize> {
    let reach = (REPEAT_SHIFT_S * design.rate_hz).round() as isize;
    let moved = || (0..design.joints()).filter(|&j| design.moved[j]);
    let mismatch = |shift: isize| {
        let pairs = overlap(first.time.len(), second.time.len(), shift);
        if 2 * pairs.len() < first.time.len().max(second.time.len()) {
            return f64::INFINITY;
        }
        let of_joint = |j: usize| {
            let (x, y) = (&first.joints[j].state[0], &second.joints[j].state[0]);
            let power: f64 = pairs.iter().map(|&(s, t)| (x[s] - y[t]).powi(2)).sum();
            let (low, high) = x
                .iter()
                .fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(*v), h.max(*v)));
            (power / pairs.len() as f64).sqrt() / (high - low).max(f64::MIN_POSITIVE)
        };
        moved().map(of_joint).fold(0.0, f64::max)
    };
    let best = (-reach..=reach).map(|s| (mismatch(s), s)).min_by(|a, b| a.0.total_cmp(&b.0))?;
    (best.0 < REPEAT_SHARE).then_some(best.1)
}

/// Pairs of samples of two runs that coincide when the second starts `shift` samples late.
fn overlap(first: usize, second: usize, shift: isize) -> Vec<(usize, usize)> {
    (0..first)
        .filter_map(|s| s.checked_add_signed(shift).filter(|&t| t < second).map(|t| (s, t)))
        .collect()
}

/// RMS in the band of white noise whose density is the median of the effort's periodogram
/// above three cut-offs:
///
/// ```text
/// rms^2 = S cutoff integral_0^inf dx / (1 + x^8)^2 = 0.898 S cutoff
/// ```
///
/// The median of a periodogram of white noise is `ln 2` of its mean.
fn white(prepared: &Prepared) -> Option<Vec<f64>> {
    let joints = prepared.runs.first()?.joints.len();
    let mut planner = RealFftPlanner::<f64>::new();
    let mut densities = vec![Vec::new(); joints];
    for run in &prepared.runs {
        let n = run.time.len();
        let first = (ABOVE_BAND * prepared.cutoff_hz * n as f64 / run.rate_hz).ceil() as usize;
        let last = (0.45 * n as f64) as usize;
        if first + 16 > last {
            return None;
        }
        let transform = planner.plan_fft_forward(n);
        for (joint, density) in run.joints.iter().zip(&mut densities) {
            // A Hann window keeps the power of the motion from leaking into the band of the noise.
            let angle = std::f64::consts::TAU / n as f64;
            let hann = |t: usize| 0.5 - 0.5 * (angle * t as f64).cos();
            let mut x: Vec<f64> =
                joint.effort.iter().enumerate().map(|(t, e)| e * hann(t)).collect();
            let mut spectrum = transform.make_output_vec();
            transform.process(&mut x, &mut spectrum).ok()?;
            let scale = 2.0 / (run.rate_hz * 0.375 * n as f64);
            density.extend(spectrum[first..last].iter().map(|c| c.norm_sqr() * scale));
        }
    }
    let rms = |mut density: Vec<f64>| {
        density.sort_by(f64::total_cmp);
        let median = density.get(density.len() / 2).copied().unwrap_or(0.0);
        (0.898 * prepared.cutoff_hz * median / std::f64::consts::LN_2).sqrt()
    };
    Some(densities.into_iter().map(rms).collect())
}
