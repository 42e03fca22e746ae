use logs::{FourierTransform, Run};

/// Width of a band in which a level is taken, as a share of the rate of the log.
const BAND: f64 = 0.05;

/// Noise of a logged command, which is what gains make of the steps of encoders: the variance of a sample in bands of
/// equal width from 0 to half the rate of the log.
///
/// ```text
/// e        = command of the noisy run - command of the same run with sensors that do not err
/// level(b) = median over band b, and over runs, of |E(f)|^2 / N / ln 2      (a periodogram is exponential)
/// S(f)     = least level of the bands from that of f on
/// ```
///
/// Gains never fall with frequency, so what falls is no noise: it is the motion, which errs with the encoder as well,
/// and of which a friction that comes loose at another instant makes more.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct CommandNoise {
    band_hz: f64,
    variances: Vec<f64>,
}

impl CommandNoise {
    /// Measures it at one joint of pairs of runs with and without errors of the sensors. A row of the one without
    /// that the other has lost is left out.
    pub fn measure(noisy: &[Run], silent: &[Run], joint: usize) -> Self {
        let count = (0.5 / BAND).round() as usize;
        let mut powers: Vec<Vec<f64>> = vec![Vec::new(); count];
        let mut rate_hz = 0.0;
        for (noisy, silent) in noisy.iter().zip(silent) {
            let Some((error, rate)) = error(noisy, silent, joint) else { continue };
            rate_hz = rate;
            let n = error.len();
            let mut signal = error;
            for (bin, value) in
                FourierTransform::default().of(&mut signal).iter().enumerate().skip(1)
            {
                let band = (bin as f64 / n as f64 / BAND) as usize;
                powers[band.min(count - 1)].push(value.norm_sqr() / n as f64);
            }
        }
        let mut variances: Vec<f64> = powers.into_iter().map(median).collect();
        for band in (1..count).rev() {
            variances[band - 1] = variances[band - 1].min(variances[band]);
        }
        for variance in &mut variances {
            *variance /= std::f64::consts::LN_2;
        }
        Self { band_hz: BAND * rate_hz, variances }
    }

    /// Variance of a sample (N^2 m^2 or N^2) at a frequency (Hz).
    pub fn at(&self, hz: f64) -> f64 {
        let band = if self.band_hz > 0.0 { (hz / self.band_hz) as usize } else { 0 };
        self.variances.get(band).or(self.variances.last()).copied().unwrap_or(0.0)
    }

    /// The largest of them.
    pub fn most(&self) -> f64 {
        self.variances.last().copied().unwrap_or(0.0)
    }
}

/// What a noisy effort is off by at the rows of a silent run, about its mean and through a window of von Hann, and
/// their rate (Hz).
fn error(noisy: &Run, silent: &Run, joint: usize) -> Option<(Vec<f64>, f64)> {
    let (first, last) = (silent.time.first()?, silent.time.last()?);
    let rows = silent.time.len().min(noisy.time.len());
    if rows < 4 || last <= first {
        return None;
    }
    let [a, b] = [noisy, silent].map(|run| &run.joints[joint].effort);
    let mut error: Vec<f64> = a.iter().zip(b).map(|(a, b)| a - b).collect();
    let mean = error.iter().sum::<f64>() / rows as f64;
    let (mut square, turn) = (0.0, std::f64::consts::TAU / rows as f64);
    for (i, e) in error.iter_mut().enumerate() {
        let window = 0.5 - 0.5 * (turn * i as f64).cos();
        square += window * window;
        *e = (*e - mean) * window;
    }
    // A windowed sample counts as a plain one.
    let plain = (rows as f64 / square).sqrt();
    error.iter_mut().for_each(|e| *e *= plain);
    Some((error, (silent.time.len() - 1) as f64 / (last - first)))
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(0.0)
}

#[cfg(test)]
mod tests {
    use rand::RngExt;
    use rand_chacha::ChaCha8Rng;
    use rand_chacha::rand_core::SeedableRng;

    use super::*;

    fn run(effort: Vec<f64>) -> Run {
        let time = (0..effort.len()).map(|i| 0.01 * i as f64).collect();
        let joint = logs::Channels { effort, ..logs::Channels::default() };
        Run {
            name: "run".to_owned(),
            source: Default::default(),
            sha256: String::new(),
            is_torn: false,
            mended: Vec::new(),
            time,
            joints: vec![joint],
            extra: Default::default(),
        }
    }

    /// Even errors of width 1 have a variance of 1/12; the slope that the two runs differ by is none, nor is a wave.
    #[test]
    fn noise_is_what_two_runs_differ_by_but_for_their_motion() {
        let mut random = ChaCha8Rng::seed_from_u64(3);
        let drift = |i: f64| 0.01 * i + (0.02 * i).sin();
        let noisy =
            (0..4000).map(|i| random.random_range(-0.5..0.5) + drift(f64::from(i))).collect();
        let silent = run(vec![0.0; 4000]);
        let noise = CommandNoise::measure(&[run(noisy)], &[silent], 0);
        for hz in [0.0, 1.0, 10.0, 49.0] {
            assert!((noise.at(hz) * 12.0 - 1.0).abs() < 0.25, "{hz} Hz: {}", 12.0 * noise.at(hz));
        }
    }

    /// What a difference makes of white noise, `4 sin^2(pi f dt)` times as much, rises with frequency and stays so.
    #[test]
    fn noise_that_rises_with_frequency_is_told_band_by_band() {
        let mut random = ChaCha8Rng::seed_from_u64(4);
        let white: Vec<f64> = (0..8001).map(|_| random.random_range(-0.5..0.5)).collect();
        let slope = white.windows(2).map(|w| w[1] - w[0]).collect();
        let noise = CommandNoise::measure(&[run(slope)], &[run(vec![0.0; 8000])], 0);
        for hz in [7.5, 22.5, 42.5] {
            let expected = 4.0 * (std::f64::consts::PI * hz * 0.01).sin().powi(2) / 12.0;
            assert!((noise.at(hz) / expected - 1.0).abs() < 0.25, "{hz} Hz: {}", noise.at(hz));
        }
    }
}
