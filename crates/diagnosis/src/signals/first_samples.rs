use logs::LowPass;

/// Scales of the first samples of a low-passed run.
///
/// A low-pass that extends its signal by the odd reflection about the first sample leaves that sample as it is, with all
/// of its noise. With `c(n)` the kernel of the filters together at the rate of the log and white noise of variance one,
/// the sample that lies `k` readings after the first has the variance
///
/// ```text
/// v(k) = (c(k) + 2 sum_{n > k} c(n))² + sum_{n > 0} (c(k - n) - c(k + n))²,   v(inf) = sum c(n)²
/// ```
///
/// Efforts and columns are multiplied by `sqrt(v(inf) / v(k))`, at most one: all samples then have one variance, and the
/// regression counts each for what it shows.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct FirstSamples {
    scales: Vec<f64>,
}

impl FirstSamples {
    /// The scales behind `low_pass`, which filters every `strides[0]`-th sample of a log that passed `thinning`, where
    /// there is one, and of which every `strides[1]`-th sample is kept.
    pub fn new(thinning: Option<&LowPass>, low_pass: &LowPass, strides: [usize; 2]) -> Self {
        let kernel = in_series(thinning, low_pass, strides[0]);
        let c = |lag: usize| kernel.get(lag).copied().unwrap_or(0.0);
        let far = 2.0 * kernel.iter().map(|c| c * c).sum::<f64>() - c(0) * c(0);
        let variance = |k: usize| {
            let first = c(k) + 2.0 * kernel.iter().skip(k + 1).sum::<f64>();
            let others = (1..kernel.len() + k).map(|n| (c(k.abs_diff(n)) - c(k + n)).powi(2));
            first * first + others.sum::<f64>()
        };
        let reached = (0..kernel.len()).step_by(strides[0] * strides[1]);
        Self { scales: reached.map(|k| (far / variance(k)).sqrt().min(1.0)).collect() }
    }

    /// Scales a signal at the rate of the regression.
    pub fn scale(&self, x: &mut [f64]) {
        x.iter_mut().zip(&self.scales).for_each(|(x, scale)| *x *= scale);
    }
}

/// The kernel of `low_pass` at every `stride`-th sample behind `thinning`, at all lags from zero (samples of the log).
fn in_series(thinning: Option<&LowPass>, low_pass: &LowPass, stride: usize) -> Vec<f64> {
    let slow = low_pass.kernel();
    let Some(thinning) = thinning else { return slow };
    let fast = thinning.kernel();
    let fast_at = |lag: usize| fast.get(lag).copied().unwrap_or(0.0);
    let at = |n: usize| {
        let parts = slow
            .iter()
            .enumerate()
            .skip(1)
            .map(|(m, h)| h * (fast_at(n.abs_diff(m * stride)) + fast_at(n + m * stride)));
        slow[0] * fast_at(n) + parts.sum::<f64>()
    };
    (0..slow.len() * stride).map(at).collect()
}

#[cfg(test)]
mod tests {
    use logs::decimate;
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    use super::*;

    /// White noise, low-passed as the signals of a log are, has one variance in every sample once it is scaled.
    #[test]
    fn noise_has_one_variance_from_the_first_sample_on() {
        for strides in [[1, 4], [3, 5]] {
            let rate_hz = 100.0;
            let low_pass = LowPass::new(4, 6.0, rate_hz).unwrap();
            let fast_hz = rate_hz * strides[0] as f64;
            let thinning = (strides[0] > 1).then(|| LowPass::new(4, 24.0, fast_hz).unwrap());
            let first_samples = FirstSamples::new(thinning.as_ref(), &low_pass, strides);
            let mut random = ChaCha8Rng::seed_from_u64(7);
            let (mut squares, mut unscaled) = ([0.0_f64; 12], 0.0);
            let runs = 4000;
            for _ in 0..runs {
                let mut x: Vec<f64> = (0..1500).map(|_| random.random_range(-1.0..1.0)).collect();
                if let Some(thinning) = &thinning {
                    thinning.apply(&mut x);
                    x = decimate(&x, strides[0]);
                }
                low_pass.apply(&mut x);
                x = decimate(&x, strides[1]);
                unscaled += x[0] * x[0] / f64::from(runs);
                first_samples.scale(&mut x);
                squares.iter_mut().zip(&x).for_each(|(sum, x)| *sum += x * x / f64::from(runs));
            }
            let far = squares[11];
            // Of 4000 squares the mean is known to 2 %; two samples, four deviations.
            for (k, square) in squares.iter().enumerate() {
                assert!((square / far - 1.0).abs() < 0.15, "{strides:?} {k}: {square}, {far}");
            }
            assert!(unscaled > 5.0 * far, "{unscaled}, {far}");
        }
    }
}
