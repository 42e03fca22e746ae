//! The choice of inducing points, the pass over the samples and the variance of a query.

#![allow(clippy::unwrap_used, reason = "a benchmark that cannot build its input has failed")]

use std::hint::black_box;

use criterion::{BatchSize, Criterion, Throughput, criterion_group, criterion_main};
use gaussian_process::{GaussianKernel, Inducing, inducing_points};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

const INPUTS: usize = 21;
const POINTS: usize = 1000;
const CANDIDATES: usize = 4000;
/// Samples of one pass: `2 n m²` is 8.2 Gflop.
const SAMPLES: usize = 4096;

fn uniform(count: usize, seed: u64) -> Vec<f64> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    (0..count).map(|_| random.random_range(-1.7..1.7)).collect()
}

fn inducing(c: &mut Criterion) {
    let kernel = GaussianKernel { signal_variance: 1.0, length_scales: vec![3.0; INPUTS] };
    let mut group = c.benchmark_group("inducing");
    group.sample_size(10);

    let candidates = uniform(CANDIDATES * INPUTS, 1);
    group.bench_function("points_1000_of_4000", |b| {
        b.iter(|| inducing_points(&candidates, &kernel, POINTS).unwrap());
    });

    let points = &candidates[..POINTS * INPUTS];
    let (inputs, targets) = (uniform(SAMPLES * INPUTS, 2), uniform(SAMPLES, 3));
    group.throughput(Throughput::Elements((2 * SAMPLES * POINTS * POINTS) as u64));
    group.bench_function("pass_4096_samples_1000_points", |b| {
        let start = || Inducing::new(points, &kernel, 0.01).unwrap();
        let pass = |mut learner: Inducing| {
            learner.add(&inputs, &targets).unwrap();
            learner
        };
        b.iter_batched(start, pass, BatchSize::LargeInput);
    });

    let mut learner = Inducing::new(points, &kernel, 0.01).unwrap();
    learner.add(&inputs, &targets).unwrap();
    let posterior = learner.finish().unwrap();
    let row = |z: &[f64]| kernel.value(z, &inputs[..INPUTS]);
    let k_star: Vec<f64> = points.chunks_exact(INPUTS).map(row).collect();
    group.throughput(Throughput::Elements(1));
    group.bench_function("variance_of_a_query_1000_points", |b| {
        b.iter(|| posterior.explained_variance(black_box(&k_star)));
    });
    let many = k_star.repeat(1000);
    group.throughput(Throughput::Elements(1000));
    group.bench_function("variance_of_1000_queries_1000_points", |b| {
        b.iter(|| posterior.explained_variances(black_box(&many)));
    });
    group.finish();
}

criterion_group!(benches, inducing);
criterion_main!(benches);
