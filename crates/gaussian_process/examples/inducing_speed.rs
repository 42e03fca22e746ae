//! Prints, as one line of JSON, what learning through inducing points takes and how well it
//! predicts runs it has not seen:
//!
//! ```text
//! cargo run --release -p gaussian_process --example inducing_speed -- 130000 2000 6000
//! ```
//!
//! with the numbers of samples, of inducing points and of candidates. Beside it the exact
//! process that learns from 3000 of the samples, with the same kernel.

#![allow(clippy::unwrap_used, reason = "a measurement that cannot be made has failed")]

use std::f64::consts::TAU;
use std::ops::Range;
use std::time::Instant;

use faer::linalg::solvers::Solve;
use faer::{Mat, Side};
use gaussian_process::{GaussianKernel, Inducing, inducing_points};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;

const JOINTS: usize = 7;
const INPUTS: usize = 3 * JOINTS;
/// Samples of a run.
const RUN: usize = 1000;
/// Seconds between two samples.
const STEP: f64 = 0.01;
/// Standard deviation of the noise; that of the torque is about 1.
const NOISE: f64 = 0.05;
/// Points of the exact process.
const EXACT: usize = 3000;

/// Maximum of the likelihood of 2500 of the samples.
const LENGTH_SCALES: [f64; INPUTS] = [
    5.2, 3.2, 2.1, 1.8, 1.9, 2.7, 14.6, 1.0, 3.4, 3.4, 3.5, 3.6, 7.3, 150.0, 7.5, 9.4, 11.4, 14.0,
    20.9, 38.2, 83.8,
];
const SIGNAL_VARIANCE: f64 = 5.2;
const NOISE_VARIANCE: f64 = 0.0031;

struct Samples {
    inputs: Vec<f64>,
    targets: Vec<f64>,
}

impl Samples {
    /// At most `n` samples, one run for each seed.
    fn of_runs(seeds: Range<u64>, n: usize) -> Self {
        let mut samples = Self { inputs: Vec::new(), targets: Vec::new() };
        for seed in seeds {
            samples.add_run(seed, RUN.min(n - samples.targets.len()));
        }
        samples
    }

    /// Positions, velocities and accelerations of joints that follow four sines each, and the
    /// torque of the first joint with friction and noise.
    fn add_run(&mut self, seed: u64, count: usize) {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let mut draw = |low: f64, high: f64| random.random_range(low..high);
        let mut sine = |k: f64| [draw(0.2, 0.6) / k, draw(0.3, 1.5) * k.sqrt(), draw(0.0, TAU)];
        let sines: Vec<[[f64; 3]; 4]> =
            (0..JOINTS).map(|_| [1.0, 2.0, 3.0, 4.0].map(&mut sine)).collect();
        for i in 0..count {
            let t = i as f64 * STEP;
            let sum = |j: usize, f: &dyn Fn(f64, f64, f64) -> f64| -> f64 {
                sines[j].iter().map(|[a, w, p]| f(*a, *w, w * t + p)).sum()
            };
            let q: [f64; JOINTS] = std::array::from_fn(|j| sum(j, &|a, _, p| a * p.sin()));
            let qd: [f64; JOINTS] = std::array::from_fn(|j| sum(j, &|a, w, p| a * w * p.cos()));
            let qdd: [f64; JOINTS] =
                std::array::from_fn(|j| sum(j, &|a, w, p| -a * w * w * p.sin()));
            // The sum of twelve uniform numbers less six is close to normal.
            let normal: f64 = (0..12).map(|_| draw(0.0, 1.0)).sum::<f64>() - 6.0;
            let friction = 0.3 * (5.0 * qd[0]).tanh();
            self.targets.push(shoulder_torque(&q, &qd, &qdd) + friction + NOISE * normal);
            self.inputs.extend(q.iter().chain(&qd).chain(&qdd));
        }
    }

    /// `count` samples at even distances.
    fn thinned(&self, count: usize) -> Self {
        let n = self.targets.len();
        let count = count.min(n);
        let places: Vec<usize> = (0..count).map(|i| i * n / count).collect();
        Self {
            inputs: rows(&self.inputs, &places),
            targets: places.iter().map(|&i| self.targets[i]).collect(),
        }
    }

    /// Mean square error of `sum_i alpha[i] k(x, z_i)` over the variance of the targets.
    fn nmse(&self, kernel: &GaussianKernel, points: &[f64], alpha: &[f64]) -> f64 {
        let mean = |x: &[f64]| -> f64 {
            let terms = points.chunks_exact(INPUTS).zip(alpha);
            terms.map(|(z, a)| a * kernel.value(x, z)).sum()
        };
        let samples = self.inputs.par_chunks_exact(INPUTS).zip(&self.targets);
        let squares: Vec<f64> = samples.map(|(x, y)| (y - mean(x)).powi(2)).collect();
        let n = squares.len() as f64;
        let centre = self.targets.iter().sum::<f64>() / n;
        let variance: f64 = self.targets.iter().map(|y| (y - centre).powi(2)).sum();
        squares.iter().sum::<f64>() / variance
    }
}

/// Torque in the first joint of a planar arm with a unit mass at the end of each link, in units
/// that give it a standard deviation of about 1: the sum of `p_k x (a_k + g)`.
fn shoulder_torque(q: &[f64], qd: &[f64], qdd: &[f64]) -> f64 {
    const LENGTH: f64 = 1.0 / 3.0;
    let (mut p, mut a) = ([0.0; 2], [0.0, 1.0]);
    let (mut angle, mut rate, mut acceleration, mut torque) = (0.0_f64, 0.0, 0.0, 0.0);
    for ((q, qd), qdd) in q.iter().zip(qd).zip(qdd) {
        angle += q;
        rate += qd;
        acceleration += qdd;
        let (sin, cos) = angle.sin_cos();
        p = [p[0] + LENGTH * cos, p[1] + LENGTH * sin];
        a[0] -= LENGTH * (sin * acceleration + cos * rate * rate);
        a[1] += LENGTH * (cos * acceleration - sin * rate * rate);
        torque += p[0] * a[1] - p[1] * a[0];
    }
    torque / 15.0
}

fn rows(inputs: &[f64], places: &[usize]) -> Vec<f64> {
    places.iter().flat_map(|i| &inputs[i * INPUTS..][..INPUTS]).copied().collect()
}

/// Weights of the exact process.
fn exact_alpha(samples: &Samples, kernel: &GaussianKernel) -> Vec<f64> {
    let n = samples.targets.len();
    let row = |i: usize| &samples.inputs[i * INPUTS..][..INPUTS];
    let noise = |i, j| if i == j { NOISE_VARIANCE } else { 0.0 };
    let k = Mat::from_fn(n, n, |i, j| noise(i, j) + kernel.value(row(i), row(j)));
    let mut alpha = Mat::from_fn(n, 1, |i, _| samples.targets[i]);
    k.llt(Side::Lower).unwrap().solve_in_place(&mut alpha);
    (0..n).map(|i| alpha[(i, 0)]).collect()
}

/// Largest memory held so far (MB), where the system tells.
fn peak_megabytes() -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM"))?;
    Some(line.split_whitespace().nth(1)?.parse::<f64>().ok()? * 1024.0 / 1e6)
}

/// The value with the seconds it took.
fn timed<T>(work: impl FnOnce() -> T) -> (T, f64) {
    let start = Instant::now();
    let value = work();
    (value, start.elapsed().as_secs_f64())
}

fn main() {
    let numbers: Vec<usize> = std::env::args().skip(1).map(|n| n.parse().unwrap()).collect();
    let &[n, m, candidates] = numbers.as_slice() else {
        return eprintln!("expected the numbers of samples, points and candidates");
    };
    let train = Samples::of_runs(0..n.div_ceil(RUN) as u64, n);
    let length_scales = LENGTH_SCALES.to_vec();
    let kernel = GaussianKernel { signal_variance: SIGNAL_VARIANCE, length_scales };

    let candidates = train.thinned(candidates);
    let (chosen, selection_s) = timed(|| inducing_points(&candidates.inputs, &kernel, m).unwrap());
    let points = rows(&candidates.inputs, &chosen);
    let (learner, pass_s) = timed(|| {
        let mut learner = Inducing::new(&points, &kernel, NOISE_VARIANCE).unwrap();
        learner.add(&train.inputs, &train.targets).unwrap();
        learner
    });
    let (posterior, finish_s) = timed(|| learner.finish().unwrap());
    let peak_mb = peak_megabytes().unwrap_or(f64::NAN);

    let test = Samples::of_runs(1000..1050, 50 * RUN).thinned(5000);
    let nmse = test.nmse(&kernel, &points, &posterior.alpha);
    let few = train.thinned(EXACT);
    let nmse_exact = test.nmse(&kernel, &few.inputs, &exact_alpha(&few, &kernel));

    let m = chosen.len();
    let gflop_per_s = 2.0 * n as f64 * (m as f64).powi(2) / pass_s / 1e9;
    println!(
        "{{\"samples\": {n}, \"points\": {m}, \"selection_s\": {selection_s:.3}, \
         \"pass_s\": {pass_s:.3}, \"finish_s\": {finish_s:.3}, \
         \"gflop_per_s\": {gflop_per_s:.1}, \"peak_mb\": {peak_mb:.0}, \
         \"jitter\": {:e}, \"unexpressed_variance\": {:.3e}, \"nmse\": {nmse:.5}, \
         \"nmse_exact_{EXACT}\": {nmse_exact:.5}}}",
        posterior.jitter, posterior.unexpressed_variance
    );
}
