//! Prints the time of one query of seven outputs and 21 inputs on one thread, and of a batch of
//! 3000 queries on every thread of the pool, for each number of points given, as lines of JSON:
//!
//! ```text
//! cargo run --release -p gaussian_process --example query_speed -- 100 3000 30000
//! python3 crates/gaussian_process/benches/peers_query.py --batch 3000 100 3000
//! ```

use std::hint::black_box;
use std::time::Instant;

use gaussian_process::{GaussianKernel, GpError, KernelSum};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

const INPUTS: usize = 21;
const OUTPUTS: usize = 7;
const BATCH: usize = 3000;

/// Multiplied by the number of points of one output: about a second of queries.
const POINTS_IN_ALL: usize = 150_000_000;

fn main() -> Result<(), GpError> {
    let given: Vec<usize> = std::env::args().skip(1).filter_map(|n| n.parse().ok()).collect();
    let standard = [100, 300, 1000, 3000, 10_000, 30_000];
    for &n in if given.is_empty() { &standard[..] } else { &given } {
        let (sum, xs) = problem(n)?;
        let [p50, p99] = single(&sum, &xs);
        println!(
            r#"{{"peer": "plumbline", "n": {n}, "microseconds_p50": {p50:.2}, "microseconds_p99": {p99:.2}}}"#
        );
        let milliseconds = batch(&sum, &xs);
        println!(
            r#"{{"peer": "plumbline", "n": {n}, "batch": {BATCH}, "milliseconds": {milliseconds:.1}}}"#
        );
    }
    Ok(())
}

/// A sum over `n` points of unit variance, and queries like them.
fn problem(n: usize) -> Result<(KernelSum, Vec<f64>), GpError> {
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    let mut draw = |count: usize, low: f64, high: f64| -> Vec<f64> {
        (0..count).map(|_| rng.random_range(low..high)).collect()
    };
    let root = 3_f64.sqrt();
    let points = draw(n * INPUTS, -root, root);
    let kernels: Vec<GaussianKernel> = (0..OUTPUTS)
        .map(|_| GaussianKernel { signal_variance: 1.0, length_scales: draw(INPUTS, 2.0, 5.0) })
        .collect();
    let alpha: Vec<Vec<f64>> = (0..OUTPUTS).map(|_| draw(n, -1.0, 1.0)).collect();
    Ok((KernelSum::new(&points, INPUTS, &kernels, &alpha)?, draw(BATCH * INPUTS, -root, root)))
}

/// Median and 99th percentile of the time of one query (microseconds).
fn single(sum: &KernelSum, xs: &[f64]) -> [f64; 2] {
    let count = (POINTS_IN_ALL / sum.len()).clamp(200, 100_000);
    let mut out = [0.0; OUTPUTS];
    let mut times: Vec<f64> = (0..count)
        .zip(xs.chunks_exact(INPUTS).cycle())
        .map(|(_, x)| {
            let start = Instant::now();
            sum.evaluate_into(black_box(x), black_box(&mut out));
            start.elapsed().as_secs_f64() * 1e6
        })
        .collect();
    times.sort_by(f64::total_cmp);
    [times[count / 2], times[count * 99 / 100]]
}

/// Median time of the batch (milliseconds).
fn batch(sum: &KernelSum, xs: &[f64]) -> f64 {
    let mut out = vec![0.0; BATCH * OUTPUTS];
    let mut times: Vec<f64> = (0..7)
        .map(|_| {
            let start = Instant::now();
            sum.evaluate_batch(black_box(xs), black_box(&mut out));
            start.elapsed().as_secs_f64() * 1e3
        })
        .collect();
    times.sort_by(f64::total_cmp);
    times[3]
}
