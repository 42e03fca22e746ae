//! One log likelihood with its gradient, 21 inputs.

#![allow(clippy::unwrap_used, reason = "a benchmark that cannot build its input has failed")]

use criterion::{Criterion, criterion_group, criterion_main};
use gaussian_process::{GaussianKernel, Likelihood};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

const INPUTS: usize = 21;

fn evidence(c: &mut Criterion) {
    let mut group = c.benchmark_group("likelihood and gradient");
    group.sample_size(10);
    for n in [1000, 3000] {
        let mut rng = ChaCha8Rng::seed_from_u64(1);
        let mut draw = |count| (0..count).map(|_| rng.random_range(-1.0..1.0)).collect();
        let (inputs, targets): (Vec<f64>, Vec<f64>) = (draw(n * INPUTS), draw(n));
        let kernel = GaussianKernel { signal_variance: 1.0, length_scales: vec![3.0; INPUTS] };
        let mut likelihood = Likelihood::new(&inputs, INPUTS).unwrap();
        let mut gradient = vec![0.0; INPUTS + 2];
        group.bench_function(n.to_string(), |b| {
            b.iter(|| likelihood.evaluate(&targets, &kernel, 0.01, &mut gradient).unwrap());
        });
    }
    group.finish();
}

criterion_group!(benches, evidence);
criterion_main!(benches);
