//! The cut-off of the low-pass, from the data.

use std::f64::consts::TAU;

use realfft::RealFftPlanner;

use crate::uniform::UniformRun;

/// Width of the bins in which the spectra of runs of different lengths are added (Hz).
const BIN_HZ: f64 = 0.05;
/// Density, as a share of the highest, above which a spectrum counts.
const LEAST_DENSITY: f64 = 1e-3;
/// Share of the power of the velocities that counts as the motion.
const MOTION_SHARE: f64 = 0.99;
/// The cut-off as a multiple of the motion's bandwidth (Gautier's rule for identification).
pub(crate) const MULTIPLE: f64 = 5.0;
/// The lowest cut-off chosen (Hz).
const LOWEST_HZ: f64 = 2.0;
/// The highest cut-off chosen, as a share of half the sampling rate.
const HIGHEST_SHARE: f64 = 0.4;

/// The cut-off (Hz), and why.
///
/// Each moving joint of each run has a power spectrum of its velocity. Of it counts what
/// is above a thousandth of its highest density, which motion is and broad-band noise is
/// not. The spectra are scaled to the same total and added; the cut-off is five times the
/// frequency below which 99 % of the sum lies, kept between 2 Hz and 0.4 of half the
/// lowest sampling rate. `moving` is per run and joint.
pub(crate) fn choose(runs: &[UniformRun], moving: &[Vec<bool>]) -> (f64, String) {
    let slowest = runs.iter().map(|r| r.rate_hz).fold(f64::INFINITY, f64::min);
    let highest = HIGHEST_SHARE * 0.5 * slowest;
    let Some(motion) = Spectrum::of(runs, moving).motion_hz() else {
        let cutoff = (MULTIPLE * LOWEST_HZ).min(highest);
        return (cutoff, format!("{cutoff:.1} Hz: no joint moves, so the data do not tell"));
    };
    let below = format!("99 % of the motion lies below {motion:.2} Hz");
    let cutoff = (10.0 * MULTIPLE * motion).round() / 10.0;
    if cutoff > highest {
        (highest, format!("{highest:.1} Hz: {below}; this is 0.4 of half the sampling rate"))
    } else if cutoff < LOWEST_HZ {
        let lowest = LOWEST_HZ.min(highest);
        (lowest, format!("{lowest:.1} Hz: {below}; no lower cut-off is chosen"))
    } else {
        (cutoff, format!("{cutoff:.1} Hz: {below}; five times that is kept"))
    }
}

/// Power of the velocities over frequency, in bins of [`BIN_HZ`].
#[derive(Default)]
struct Spectrum {
    bins: Vec<f64>,
}

impl Spectrum {
    fn of(runs: &[UniformRun], moving: &[Vec<bool>]) -> Self {
        let mut sum = Self::default();
        let mut planner = RealFftPlanner::new();
        for (run, moves) in runs.iter().zip(moving) {
            for (joint, _) in run.joints.iter().zip(moves).filter(|(_, moves)| **moves) {
                let velocity = joint.raw_velocity(run.rate_hz);
                sum.add(&power(velocity, &mut planner), run.rate_hz);
            }
        }
        sum
    }

    /// Adds what counts of a one-sided power spectrum, scaled to a total of one.
    fn add(&mut self, power: &[f64], rate_hz: f64) {
        let least = LEAST_DENSITY * power.iter().copied().fold(0.0, f64::max);
        let counted = |p: &&f64| **p > least;
        let total: f64 = power.iter().filter(counted).sum();
        let step_hz = 0.5 * rate_hz / (power.len() - 1).max(1) as f64;
        let count = (0.5 * rate_hz / BIN_HZ) as usize + 1;
        self.bins.resize(self.bins.len().max(count), 0.0);
        for (k, p) in power.iter().enumerate().filter(|(_, p)| counted(p)) {
            let bin = (k as f64 * step_hz / BIN_HZ) as usize;
            self.bins[bin.min(count - 1)] += p / total;
        }
    }

    /// Frequency below which the motion lies (Hz); `None` without motion.
    fn motion_hz(&self) -> Option<f64> {
        let total: f64 = self.bins.iter().sum();
        let mut below = 0.0;
        let bin = self.bins.iter().position(|p| {
            below += p;
            below >= MOTION_SHARE * total
        });
        bin.filter(|_| total > 0.0).map(|bin| (bin + 1) as f64 * BIN_HZ)
    }
}

/// One-sided power spectrum of a signal without its mean, under a Hann window.
fn power(mut x: Vec<f64>, planner: &mut RealFftPlanner<f64>) -> Vec<f64> {
    let n = x.len();
    let mean = x.iter().sum::<f64>() / n as f64;
    for (k, value) in x.iter_mut().enumerate() {
        let window = 0.5 - 0.5 * (TAU * k as f64 / n as f64).cos();
        *value = (*value - mean) * window;
    }
    let transform = planner.plan_fft_forward(n);
    let mut spectrum = transform.make_output_vec();
    match transform.process(&mut x, &mut spectrum) {
        Ok(()) => spectrum.iter().map(|c| c.norm_sqr()).collect(),
        // Lengths come from the plan itself, so this does not happen; no power is no claim.
        Err(_) => vec![0.0],
    }
}
