use std::f64::consts::TAU;

use logs::FourierTransform;

/// Power of a residual over frequency.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Spectrum {
    /// Frequency (Hz) and power of each bin of every run ((N·m)² or N²).
    bins: Vec<(f64, f64)>,
    samples: usize,
    rate_hz: f64,
}

impl Spectrum {
    /// Spectrum of a residual, `[run][sample]`, at one rate: periodograms with a Hann window, without the mean.
    pub fn of(left: &[Vec<f64>], rate_hz: f64) -> Self {
        let mut fourier = FourierTransform::default();
        let mut bins = Vec::new();
        for run in left.iter().filter(|run| run.len() > 8) {
            let n = run.len();
            let mean = run.iter().sum::<f64>() / n as f64;
            let hann = |t: usize| 0.5 - 0.5 * (TAU * t as f64 / n as f64).cos();
            let mut x: Vec<f64> =
                run.iter().enumerate().map(|(t, v)| (v - mean) * hann(t)).collect();
            // The window keeps 3/8 of the power, half of which is at negative frequencies.
            let scale = 2.0 / (0.375 * n as f64);
            let hz = |k: usize| k as f64 * rate_hz / n as f64;
            let power = |(k, c): (usize, &nalgebra::Complex<f64>)| (hz(k), scale * c.norm_sqr());
            bins.extend(fourier.of(&mut x).iter().enumerate().skip(1).map(power));
        }
        bins.sort_by(|a, b| a.0.total_cmp(&b.0));
        Self { bins, samples: left.iter().map(Vec::len).sum(), rate_hz }
    }

    /// One-sided density ((N·m)²/Hz or N²/Hz) between neighbours of some rising frequencies (Hz); zero between
    /// neighbours without a bin.
    pub fn densities(&self, at_hz: &[f64]) -> Vec<f64> {
        let edge = |k: usize| match (k.checked_sub(1).and_then(|i| at_hz.get(i)), at_hz.get(k)) {
            (Some(low), Some(high)) => (low * high).sqrt(),
            (None, _) => 0.0,
            (_, None) => f64::INFINITY,
        };
        let density = |k: usize| {
            let from = self.bins.partition_point(|(hz, _)| *hz < edge(k));
            let to = self.bins.partition_point(|(hz, _)| *hz < edge(k + 1));
            let mean =
                self.bins[from..to].iter().map(|(_, p)| p).sum::<f64>() / (to - from).max(1) as f64;
            mean / self.rate_hz
        };
        (0..at_hz.len()).map(density).collect()
    }

    /// The frequency above which a `share` of the power lies (Hz); `None` without power.
    pub fn above_hz(&self, share: f64) -> Option<f64> {
        let total: f64 = self.bins.iter().map(|(_, p)| p).sum();
        let mut above = total;
        let bin = self.bins.iter().find(|(_, p)| {
            above -= p;
            above < share * total
        });
        bin.map(|(hz, _)| *hz).filter(|_| total > 0.0 && self.samples > 0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 20 s of a sine of amplitude 2 at 5 Hz, of power 2.
    #[test]
    fn oracle_a_sine_is_above_what_is_just_below_it_and_has_half_its_square_as_power() {
        let x = (0..2000).map(|t| 2.0 * (TAU * 5.0 * f64::from(t) / 100.0).sin()).collect();
        let spectrum = Spectrum::of(&[x], 100.0);
        let above = spectrum.above_hz(0.9).unwrap();
        assert!((above - 5.0).abs() < 0.11, "{above}");
        // Bins of .05 Hz: the density times the band between the edges is the power.
        let at = [1.0, 5.0, 25.0];
        let density = spectrum.densities(&at)[1];
        let power = density * ((5.0_f64 * 25.0).sqrt() - 5.0_f64.sqrt());
        assert!((power / 2.0 - 1.0).abs() < 0.02, "{power}");
    }
}
