//! Time of one log likelihood with gradient, beside the machine's peak of fused multiply-adds
//! and the value itself, as a line of JSON:
//!
//! ```text
//! RAYON_NUM_THREADS=2 cargo run --release -p gaussian_process --example evidence_speed -- 3000 15
//! ```
//!
//! for so many points of a seven-joint arm on sums of sinusoids (21 inputs), with so many repeats, of which the least time
//! counts on both sides.

use std::hint::black_box;
use std::time::Instant;

use gaussian_process::{GaussianKernel, GpError, Likelihood};
use pulp::{Arch, Simd, WithSimd};

const JOINTS: usize = 7;

/// Steps of the peak loop: about 1 ms, so that some of them are not disturbed on a busy machine.
const STEPS: usize = 500_000;

/// Peak loops after each evaluation.
const LOOPS: usize = 50;

/// Sums that are independent of each other: enough to hide the latency of one step.
const SUMS: usize = 12;

/// Fused multiply-adds that touch nothing but registers. Returns operations done.
struct Peak;

impl WithSimd for Peak {
    type Output = f64;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> f64 {
        let mut sums = [simd.splat_f64s(1.0); SUMS];
        let (a, b) = (simd.splat_f64s(black_box(0.999)), simd.splat_f64s(black_box(1e-3)));
        for _ in 0..STEPS {
            for sum in &mut sums {
                *sum = simd.mul_add_e_f64s(*sum, a, b);
            }
        }
        black_box(sums.map(|sum| simd.reduce_sum_f64s(sum)));
        (2 * SUMS * S::F64_LANES * STEPS) as f64
    }
}

/// Inputs `q`, `qd`, `qdd` and a torque of the first joint, all of about unit size.
fn arm(n: usize) -> (Vec<f64>, Vec<f64>) {
    let (mut inputs, mut targets) = (Vec::new(), Vec::new());
    for i in 0..n {
        let t = 0.7 * i as f64;
        let mut x = [0.0; 3 * JOINTS];
        for j in 0..JOINTS {
            for k in 1..=3 {
                let rate = 0.31 * k as f64 + 0.07 * j as f64;
                let (sine, cosine) = (rate * t + (j * k) as f64).sin_cos();
                x[j] += sine;
                x[JOINTS + j] += rate * cosine;
                x[2 * JOINTS + j] -= rate * rate * sine;
            }
        }
        // A number between -0.5 and 0.5 that a sinusoid does not predict.
        let noise = (12.9898 * i as f64).sin() * 1000.0;
        let noise = noise - noise.floor() - 0.5;
        targets.push((2.0 + x[1].cos()) * x[14] + x[0].sin() + 0.5 * x[7] * x[8] + 0.2 * noise);
        inputs.extend(x);
    }
    (inputs, targets)
}

/// Most memory that was ever held (GB), where the system tells.
fn peak_memory() -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM"))?;
    Some(line.split_whitespace().nth(1)?.parse::<f64>().ok()? * 1024.0 / 1e9)
}

fn main() -> Result<(), GpError> {
    let mut arguments = std::env::args().skip(1).filter_map(|a| a.parse::<usize>().ok());
    let n = arguments.next().unwrap_or(3000);
    let repeats = arguments.next().unwrap_or(15);
    let (inputs, targets) = arm(n);
    let kernel = GaussianKernel { signal_variance: 1.0, length_scales: vec![3.0; 3 * JOINTS] };
    let mut likelihood = Likelihood::new(&inputs, 3 * JOINTS)?;
    let mut gradient = vec![0.0; 3 * JOINTS + 2];
    let (mut seconds, mut per_operation, mut value) = (f64::INFINITY, f64::INFINITY, 0.0);
    for _ in 0..=repeats {
        let start = Instant::now();
        value = likelihood.evaluate(&targets, &kernel, 0.01, &mut gradient)?.log_likelihood;
        seconds = seconds.min(start.elapsed().as_secs_f64());
        for _ in 0..LOOPS {
            let start = Instant::now();
            let operations: f64 = rayon::broadcast(|_| Arch::new().dispatch(Peak)).iter().sum();
            per_operation = per_operation.min(start.elapsed().as_secs_f64() / operations);
        }
    }
    let peak = 1e-9 / per_operation;
    let rate = 1e-9 * (n as f64).powi(3) / seconds;
    println!(
        r#"{{"n": {n}, "threads": {}, "seconds": {seconds:.6}, "gflops": {rate:.1}, "fma_peak_gflops": {peak:.1}, "share": {:.3}, "peak_gb": {}, "log_likelihood": {value:.6}}}"#,
        rayon::current_num_threads(),
        rate / peak,
        peak_memory().map_or("null".to_owned(), |gb| format!("{gb:.3}")),
    );
    Ok(())
}
