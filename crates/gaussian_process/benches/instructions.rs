//! Instructions of the hot loops, counted by valgrind and held under the limits written here, so
//! that a loop which no longer fits the registers or is no longer inlined fails on a busy machine
//! too. Valgrind knows no AVX-512: what is counted is the AVX2 path.
//!
//! ```text
//! apt-get install valgrind
//! cargo install gungraun-runner --version 0.20.0
//! RUSTFLAGS="--cfg instructions" cargo bench -p gaussian_process --bench instructions \
//!     --target-dir target/instructions
//! ```

#[cfg(not(instructions))]
fn main() {
    println!(
        "nothing is counted without RUSTFLAGS=\"--cfg instructions\": see benches/instructions.rs"
    );
}

#[cfg(instructions)]
use counted::loops;

#[cfg(instructions)]
gungraun::main!(library_benchmark_groups = loops);

#[cfg(instructions)]
#[allow(clippy::unwrap_used, reason = "a benchmark that cannot build its input has failed")]
mod counted {
    use std::hint::black_box;

    use gaussian_process::{GaussianKernel, KernelSum, Likelihood};
    use gungraun::prelude::*;
    use gungraun::{Callgrind, EventKind};

    /// Two per cent above what rustc 1.95 gives.
    fn limit(instructions: u64) -> LibraryBenchmarkConfig {
        let most = [(EventKind::Ir, instructions + instructions / 50)];
        LibraryBenchmarkConfig::default().tool(Callgrind::default().hard_limits(most)).clone()
    }

    /// A sum over 3000 points.
    fn sum(inputs: usize, outputs: usize) -> KernelSum {
        let n = 3000;
        let points: Vec<f64> = (0..n * inputs).map(|i| (i as f64).sin()).collect();
        let kernel = GaussianKernel { signal_variance: 1.0, length_scales: vec![3.0; inputs] };
        let alpha = vec![vec![1.0; n]; outputs];
        KernelSum::new(&points, inputs, &vec![kernel; outputs], &alpha).unwrap()
    }

    #[library_benchmark(config = limit(563_000))]
    #[bench::seven_outputs((sum(21, 7), [0.0; 7]))]
    fn query((sum, mut f): (KernelSum, [f64; 7])) -> (KernelSum, [f64; 7]) {
        sum.evaluate_into(black_box(&[0.5; 21]), &mut f);
        (sum, f)
    }

    #[library_benchmark(config = limit(197_500))]
    #[bench::one_output((sum(21, 7), vec![0.0; 3000]))]
    fn covariances((sum, mut k_star): (KernelSum, Vec<f64>)) -> (KernelSum, Vec<f64>) {
        sum.covariances_into(3, black_box(&[0.5; 21]), &mut k_star);
        (sum, k_star)
    }

    /// Room for 240 points of 21 inputs, and their targets.
    fn likelihood() -> (Likelihood, Vec<f64>) {
        let inputs: Vec<f64> = (0..240 * 21).map(|i| (i as f64).sin()).collect();
        let targets = (0..240).map(|i| (0.1 * f64::from(i)).cos()).collect();
        (Likelihood::new(&inputs, 21).unwrap(), targets)
    }

    // Assembly, sweep (240³ operations) and gradient.
    #[library_benchmark(config = limit(2_621_000))]
    #[bench::with_gradient(likelihood())]
    fn evaluation((mut likelihood, targets): (Likelihood, Vec<f64>)) -> [f64; 23] {
        let kernel = GaussianKernel { signal_variance: 1.0, length_scales: vec![3.0; 21] };
        let mut gradient = [0.0; 23];
        likelihood.evaluate(black_box(&targets), &kernel, 1e-2, &mut gradient).unwrap();
        gradient
    }

    library_benchmark_group!(name = loops, benchmarks = [query, covariances, evaluation]);
}
