//! The frequency band of the motion, and the acceleration in it.

use std::f64::consts::TAU;

use crate::signals::{
    differentiate::differentiate,
    fourier_transform::FourierTransform,
    noise::ChannelNoise,
    spectrum::Density,
    uniform::{UniformJoint, UniformRun},
};

/// Width of the bins in which the spectra of runs of different lengths are added (Hz).
const BIN_HZ: f64 = 0.05;
/// Density, as a share of the highest, above which a velocity counts as motion.
const LEAST_DENSITY: f64 = 1e-3;
/// Density, as a multiple of the noise density, above which a position counts as motion. One bin in 22000 of
/// white noise exceeds it.
const ABOVE_NOISE: f64 = 10.0;
/// Power of the positions above a frequency, as a multiple of the noise power there, above which it counts as motion.
const ABOVE_ALL_NOISE: f64 = 3.0;
/// Share of the power of the velocities that counts as the motion.
const MOTION_SHARE: f64 = 0.99;
/// The same share for the larger part of the motion, which must not be cut because of noise.
const MOST_SHARE: f64 = 0.95;

/// The frequency band of the motion in a log.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct MotionBand {
    /// Frequency below which the motion of all joints lies (Hz); `None` where nothing moves.
    pub motion_hz: Option<f64>,
    /// Frequency below which the larger part of the motion lies (Hz).
    pub most_hz: Option<f64>,
    /// Acceleration of each joint's motion.
    pub accelerations: Vec<Accelerations>,
}

/// Acceleration in the motion of a joint.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Accelerations {
    /// Time over which the joint moves (s).
    length_s: f64,
    /// Mean square times that time, in bins of [`BIN_HZ`] ((rad/s²)² s or (m/s²)² s).
    bins: Vec<f64>,
}

/// The pieces of a log, which joints move in each, and the noise of each joint's position in
/// each piece.
#[derive(Clone, Copy)]
pub(crate) struct BandInputs<'a> {
    pub pieces: &'a [UniformRun],
    pub moving: &'a [Vec<bool>],
    pub noise: &'a [Vec<ChannelNoise>],
}

impl BandInputs<'_> {
    /// The band of the motion.
    ///
    /// The power spectrum of each moving joint's velocity is computed from differences of its position.
    /// Bins of it count as motion that are
    ///
    /// - above a thousandth of its highest density,
    /// - above ten times the density `(2 pi f)^2 S_q` of the noise,
    /// - below the frequency above which the position has no more than three times the power of its
    ///   noise. The last condition is needed since an encoder passed evenly has lines in its spectrum, no white noise.
    ///
    /// The spectra are scaled to the same total and added. The motion lies below the frequency
    /// below which 99 % of the sum lies.
    pub(crate) fn band(&self) -> MotionBand {
        let (mut sum, mut fourier) = (Velocities::default(), FourierTransform::default());
        let mut accelerations = vec![Accelerations::default(); self.noise.len()];
        for (k, (piece, moves)) in self.pieces.iter().zip(self.moving).enumerate() {
            for (j, joint) in piece.joints.iter().enumerate().filter(|(j, _)| moves[*j]) {
                let velocity = velocity(joint, piece.rate_hz, &mut fourier);
                let counted = motion_density(&velocity, &self.noise[j][k]);
                sum.add(&counted);
                accelerations[j].add(&counted, piece.duration_s());
            }
        }
        let [most_hz, motion_hz] = [MOST_SHARE, MOTION_SHARE].map(|share| sum.edge_hz(share));
        MotionBand { motion_hz, most_hz, accelerations }
    }
}

impl Accelerations {
    /// Acceleration of the motion below a frequency, RMS over the pieces in which the joint moves
    /// (rad/s² or m/s²).
    pub(crate) fn below(&self, hz: f64) -> f64 {
        let bins = ((hz / BIN_HZ) as usize).min(self.bins.len());
        let square: f64 = self.bins[..bins].iter().sum();
        if self.length_s > 0.0 { (square / self.length_s).sqrt() } else { 0.0 }
    }

    fn add(&mut self, velocity: &Density, length_s: f64) {
        self.length_s += length_s;
        for (k, p) in velocity.bins.iter().enumerate().filter(|(_, p)| **p > 0.0) {
            let hz = k as f64 * velocity.step_hz;
            *bin(&mut self.bins, hz) += (TAU * hz).powi(2) * p * velocity.step_hz * length_s;
        }
    }
}

/// Most bins; higher frequencies count in the last one. A log whose time hardly advances can have any rate.
const MOST_BINS: usize = 1 << 22;

/// The bin of [`BIN_HZ`] in which a frequency lies.
fn bin(bins: &mut Vec<f64>, hz: f64) -> &mut f64 {
    let bin = ((hz / BIN_HZ) as usize).min(MOST_BINS - 1);
    bins.resize(bins.len().max(bin + 1), 0.0);
    &mut bins[bin]
}

/// Share of the samples that may be faster than any motion: spikes and lost turns.
const OUTLIERS: f64 = 0.005;
/// Highest speed of the motion, as a multiple of the highest speed of all other samples.
const FASTEST: f64 = 3.0;

/// Density of the velocity of a joint, by differences of its position. Speeds are limited to three times that of
/// all but one sample in 200.
fn velocity(joint: &UniformJoint, rate_hz: f64, fourier: &mut FourierTransform) -> Density {
    let mut velocity = differentiate(&joint.q, rate_hz);
    let mut speeds: Vec<f64> = velocity.iter().map(|v| v.abs()).collect();
    let place = ((1.0 - OUTLIERS) * speeds.len() as f64) as usize;
    if place < speeds.len() {
        let fastest = FASTEST * *speeds.select_nth_unstable_by(place, f64::total_cmp).1;
        // Differences of numbers of any size may be no number, which `clamp` does not take.
        velocity.iter_mut().for_each(|v| *v = v.min(fastest).max(-fastest));
    }
    Density::of(&velocity, rate_hz, fourier)
}

/// Density of a velocity where it counts as motion, zero elsewhere.
fn motion_density(velocity: &Density, noise: &ChannelNoise) -> Density {
    let q = velocity.integrate();
    let end = end_of_motion(&q, noise);
    let least = LEAST_DENSITY * velocity.bins.iter().copied().fold(0.0, f64::max);
    let counts = |k: usize, p: f64| {
        k < end && p > least && (k == 0 || q.bins[k] > ABOVE_NOISE * noise.density)
    };
    let bins = velocity.bins.iter().enumerate();
    let bins = bins.map(|(k, &p)| if counts(k, p) { p } else { 0.0 }).collect();
    Density { step_hz: velocity.step_hz, bins }
}

/// The bin above which a position has no more than three times the power of its noise: of white noise
/// up to half the sampling rate, or of rounding at any frequency.
fn end_of_motion(q: &Density, noise: &ChannelNoise) -> usize {
    let rounding = noise.step.map_or(0.0, |h| h * h / 12.0);
    let mut held = 0.0;
    for (k, p) in q.bins.iter().enumerate().rev() {
        held += p * q.step_hz;
        let white = noise.density * (q.bins.len() - k) as f64 * q.step_hz;
        if held > ABOVE_ALL_NOISE * white.max(rounding) {
            return k + 1;
        }
    }
    0
}

/// Power of the velocities over frequency, in bins of [`BIN_HZ`].
#[derive(Default)]
struct Velocities {
    bins: Vec<f64>,
}

impl Velocities {
    /// Adds a density, scaled to a total of one.
    fn add(&mut self, velocity: &Density) {
        let total: f64 = velocity.bins.iter().sum();
        if total <= 0.0 {
            return;
        }
        for (k, p) in velocity.bins.iter().enumerate().filter(|(_, p)| **p > 0.0) {
            *bin(&mut self.bins, k as f64 * velocity.step_hz) += p / total;
        }
    }

    /// Frequency below which a share of the sum lies (Hz); `None` without motion.
    fn edge_hz(&self, share: f64) -> Option<f64> {
        let total: f64 = self.bins.iter().sum();
        let mut below = 0.0;
        let bin = self.bins.iter().position(|p| {
            below += p;
            below >= share * total
        });
        bin.filter(|_| total > 0.0).map(|bin| (bin + 1) as f64 * BIN_HZ)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A time that hardly goes on has rates beyond all numbers.
    #[test]
    fn a_frequency_beyond_all_bins_counts_in_the_last_one() {
        let mut accelerations = Accelerations::default();
        accelerations.add(&Density { step_hz: 1e300, bins: vec![0.0, 1e-300] }, 1.0);
        assert_eq!(accelerations.bins.len(), MOST_BINS);
    }

    #[test]
    fn positions_whose_differences_are_no_numbers_end_nothing() {
        let q = (0..400).map(|k| if k % 2 == 0 { 1.7e308 } else { -1.7e308 }).collect();
        let joint = UniformJoint {
            q,
            effort: vec![],
            velocity: None,
            acceleration: None,
            link: None,
            goal_effort: None,
        };
        velocity(&joint, 1000.0, &mut FourierTransform::default());
    }
}
