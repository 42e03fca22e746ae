use realfft::RealFftPlanner;
use realfft::num_complex::Complex;

/// Discrete Fourier transforms of real samples; the plan of every length is kept.
///
/// Only this type instantiates `realfft`, since every package that does so compiles all of it again.
pub struct FourierTransform {
    planner: RealFftPlanner<f64>,
}

impl Default for FourierTransform {
    fn default() -> Self {
        Self { planner: RealFftPlanner::new() }
    }
}

impl std::fmt::Debug for FourierTransform {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("FourierTransform").finish_non_exhaustive()
    }
}

impl FourierTransform {
    /// The transform of `N` samples at frequencies from zero to half their rate; empty without samples. The samples
    /// are overwritten.
    ///
    /// ```text
    /// X[k] = sum over n of x[n] exp(-i 2 pi k n / N),   k = 0 .. N / 2
    /// ```
    #[must_use]
    pub fn of(&mut self, samples: &mut [f64]) -> Vec<Complex<f64>> {
        if samples.is_empty() {
            return Vec::new();
        }
        let transform = self.planner.plan_fft_forward(samples.len());
        let mut spectrum = transform.make_output_vec();
        // It fails for other lengths than those of its plan alone.
        match transform.process(samples, &mut spectrum) {
            Ok(()) => spectrum,
            Err(_) => Vec::new(),
        }
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;

    #[test]
    fn the_transform_is_the_sum_that_defines_it_at_any_length() {
        for n in [0, 1, 2, 7, 16, 31, 60, 97] {
            let x: Vec<f64> = (0..n).map(|t| ((t * t) as f64).sin() + 0.3).collect();
            let found = FourierTransform::default().of(&mut x.clone());
            assert_eq!(found.len(), if n == 0 { 0 } else { n / 2 + 1 });
            for (k, value) in found.iter().enumerate() {
                let turn = |t: usize| Complex::cis(-TAU * (k * t) as f64 / n as f64);
                let expected: Complex<f64> = x.iter().enumerate().map(|(t, x)| turn(t) * *x).sum();
                assert!((value - expected).norm() < 1e-11, "{n} {k}: {value} {expected}");
            }
        }
    }
}
