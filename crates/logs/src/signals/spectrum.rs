//! Power densities of signals, and the parts in which they are flat.

use std::f64::consts::{LN_2, SQRT_2, TAU};

use realfft::num_complex::Complex;

use crate::signals::fourier_transform::FourierTransform;

/// Highest frequency that is used, as a share of half the sampling rate. The filters of loggers and
/// the interpolation to a uniform clock act above it.
const HIGHEST_SHARE: f64 = 0.95;
/// Fewest bins whose median is taken as a density.
const FEWEST_BINS: usize = 5;
/// Largest change of a flat density over half an octave and over an octave (decades).
const FLAT_HALF: f64 = 0.4;
const FLAT_OCTAVE: f64 = 0.45;
/// Fewest half octaves that make a flat stretch.
const FEWEST_FLAT: usize = 3;
/// Fall of a density over half an octave that only a filter causes (decades): `f^-12`. The
/// corners of a motion fall with `f^-4` to `f^-8`.
const FILTER_EDGE: f64 = 1.8;

/// One-sided power density of a signal over frequency.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Density {
    /// Width of a bin (Hz); bin `k` lies at `k` times the width.
    pub step_hz: f64,
    /// Density of each bin (unit^2/Hz).
    pub bins: Vec<f64>,
}

/// A flat part of a density.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Flat {
    /// Level of the flat part (unit^2/Hz).
    pub density: f64,
    /// Width of the flat part (octaves).
    pub octaves: f64,
    /// Whether the density below the flat part in frequency falls as steeply as only a low-pass causes. The flat part
    /// then does not show the noise in the band of the motion.
    pub is_filtered: bool,
}

/// Median density between two frequencies half an octave apart.
#[derive(Debug, Clone, Copy)]
struct HalfOctave {
    decades: f64,
}

impl Density {
    /// Hann periodogram of a signal without its mean:
    ///
    /// ```text
    /// P[k] = 2 |sum w (x - mean) exp(-i 2 pi k n / N)|^2 / (rate sum w^2)
    /// ```
    ///
    /// The sum of `P` times the width of a bin is the variance of the signal. The last few per cent of the samples
    /// are left out where a shorter length has only small factors: a prime length takes four times as
    /// long.
    pub(crate) fn of(x: &[f64], rate_hz: f64, fourier: &mut FourierTransform) -> Self {
        let x = &x[..of_small_factors(x.len())];
        let n = x.len();
        let mean = x.iter().sum::<f64>() / n.max(1) as f64;
        let window = |k: usize| 0.5 - 0.5 * (TAU * k as f64 / n as f64).cos();
        let weight: f64 = (0..n).map(|k| window(k).powi(2)).sum();
        let mut x: Vec<f64> = x.iter().enumerate().map(|(k, x)| window(k) * (x - mean)).collect();
        let step_hz = rate_hz / n.max(1) as f64;
        if n < 2 {
            return Self { step_hz, bins: vec![0.0] };
        }
        let power = |c: &Complex<f64>| 2.0 * c.norm_sqr() / (rate_hz * weight);
        let bins = fourier.of(&mut x).iter().map(power).collect();
        Self { step_hz, bins }
    }

    /// The density divided by `(2 pi f)^2`: the density of the integral of the signal.
    pub(crate) fn integrate(&self) -> Self {
        let over = |(k, p): (usize, &f64)| match k {
            0 => 0.0,
            _ => p / (TAU * k as f64 * self.step_hz).powi(2),
        };
        Self { step_hz: self.step_hz, bins: self.bins.iter().enumerate().map(over).collect() }
    }

    /// Frequency below which a share of the power lies (Hz).
    pub(crate) fn edge_hz(&self, share: f64) -> f64 {
        let total: f64 = self.bins.iter().sum();
        let mut below = 0.0;
        let edge = self.bins.iter().position(|p| {
            below += p;
            below >= share * total
        });
        edge.map_or(0.0, |k| (k + 1) as f64 * self.step_hz)
    }

    /// The flat part with the highest frequencies above `from_hz`: three half octaves or more
    /// over which the density changes by less than `f^1.5`; `None` without one.
    ///
    /// Its density is the exponential of the mean logarithm of the half octaves' medians, divided by `ln 2`. For bins
    /// that scatter as white noise does this is the mean density, and it ignores lines.
    pub(crate) fn flat_above(&self, from_hz: f64) -> Option<Flat> {
        let bands = self.half_octaves(from_hz);
        let mut start = 0;
        while start + FEWEST_FLAT <= bands.len() {
            let length = flat_length(&bands[start..]);
            if length >= FEWEST_FLAT {
                return Some(flat(&bands, start, length));
            }
            start += 1;
        }
        None
    }

    /// Median densities of half octaves, from the highest down to `from_hz`.
    fn half_octaves(&self, from_hz: f64) -> Vec<HalfOctave> {
        let mut bands = Vec::new();
        let mut high = HIGHEST_SHARE * self.step_hz * self.bins.len().saturating_sub(1) as f64;
        while high / SQRT_2 >= from_hz {
            let low = high / SQRT_2;
            let [first, end] = [low, high].map(|f| (f / self.step_hz).ceil() as usize);
            let mut inside = self.bins.get(first..end).unwrap_or_default().to_vec();
            if inside.len() < FEWEST_BINS {
                break;
            }
            let middle = inside.len() / 2;
            let median = *inside.select_nth_unstable_by(middle, f64::total_cmp).1;
            bands.push(HalfOctave { decades: (median / LN_2).max(f64::MIN_POSITIVE).log10() });
            high = low;
        }
        bands
    }
}

/// The largest number up to `n` with no prime factors other than 2, 3 and 5.
fn of_small_factors(n: usize) -> usize {
    let is_small = |n: &usize| {
        let mut left = *n;
        for factor in [2_usize, 3, 5] {
            while left.is_multiple_of(factor) {
                left /= factor;
            }
        }
        left == 1
    };
    (1..=n).rev().find(is_small).unwrap_or(n)
}

/// Number of half octaves from the first on over which the density is flat.
fn flat_length(bands: &[HalfOctave]) -> usize {
    let change = |a: usize, b: usize| (bands[a].decades - bands[b].decades).abs();
    let is_flat =
        |k: usize| change(k, k - 1) <= FLAT_HALF && (k < 2 || change(k, k - 2) <= FLAT_OCTAVE);
    1 + (1..bands.len()).take_while(|&k| is_flat(k)).count()
}

fn flat(bands: &[HalfOctave], start: usize, length: usize) -> Flat {
    let inside = &bands[start..start + length];
    let decades = inside.iter().map(|b| b.decades).sum::<f64>() / length as f64;
    let below = &bands[start + length - 1..];
    let is_filtered = below.windows(2).any(|b| b[1].decades - b[0].decades >= FILTER_EDGE);
    Flat { density: 10_f64.powf(decades), octaves: 0.5 * length as f64, is_filtered }
}
