use nalgebra::{Complex, DVector};

use crate::oscillations::arrow_matrix::{ArrowFactor, ArrowMatrix};
use crate::signals::along::Wave;

/// Rounds of Gauss-Newton: the first fits the amplitudes, the others the beat too.
const ROUNDS: usize = 5;

/// A sine of one beat in the residual of a joint, by least squares in every run.
///
/// ```text
/// left_r = Re(z_r L exp(i at (beat - origin_r))),   L the low-pass of the logs
/// ```
///
/// by Gauss-Newton in `at` and all `z`. Over position, a projection onto `exp(i at beat)` would be some per cent off:
/// the phase is constant where a joint turns or stands, so that the sum of `exp(2 i at beat)` does not vanish.
#[derive(Debug, Clone)]
pub(crate) struct ToneFit {
    /// Phase per unit of beat (rad/s; 1 or rad/m).
    pub at: f64,
    /// `z` at beat zero, of every run (N·m or N).
    pub z: Vec<Complex<f64>>,
    /// Variances of the mean amplitude, of `at` and of the phase at beat zero, in variances of a sample of white
    /// noise.
    pub variances: [f64; 3],
}

/// The residual of one run, to which a sine is fitted.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Sampled<'a> {
    /// Residual (N·m or N).
    pub left: &'a [f64],
    /// Whether a sample counts.
    pub counts: &'a [bool],
    /// Mean beat of the samples that count.
    pub origin: f64,
}

/// Which runs share one `z`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Coherence {
    AllRuns,
    EachRun,
}

impl ToneFit {
    /// Starts from a phase per unit of beat, which changes by at most `step` in a round. `wave` is the sine of a run.
    /// `None` where the runs do not determine the fit.
    pub fn new(
        runs: &[Sampled],
        coherence: Coherence,
        [start, step]: [f64; 2],
        wave: impl Fn(usize, f64, f64) -> Wave,
    ) -> Option<Self> {
        let sizes = match coherence {
            Coherence::AllRuns => 1,
            Coherence::EachRun => runs.len(),
        };
        let of = |r: usize| if sizes == 1 { 0 } else { r };
        let mut at = start;
        let mut z = vec![Complex::new(0.0, 0.0); sizes];
        let mut factor = None;
        for _ in 0..ROUNDS {
            let width = 2 * sizes + 1;
            let (mut normal, mut score) = (ArrowMatrix::zeros(sizes), DVector::zeros(width));
            for (r, run) in runs.iter().enumerate() {
                let wave = wave(r, at, run.origin);
                let places = [2 * of(r), 2 * of(r) + 1, width - 1];
                for (row, y) in rows(run, &wave, z[of(r)]) {
                    normal.add(of(r), row);
                    places.into_iter().zip(row).for_each(|(i, a)| score[i] += a * y);
                }
            }
            // For a sine of amplitude zero the beat is arbitrary.
            let of_beat = normal.corner_mut();
            if *of_beat <= 0.0 {
                *of_beat = 1.0;
            }
            let normal = factor.insert(normal.factor()?);
            normal.solve(&mut score);
            let change = score;
            z.iter_mut().enumerate().for_each(|(s, z)| {
                *z += Complex::new(change[2 * s], change[2 * s + 1]);
            });
            at += change[width - 1].clamp(-step, step);
        }
        let origins = runs.iter().map(|run| run.origin);
        let origin = origins.sum::<f64>() / runs.len().max(1) as f64;
        let variances = variances(&z, &factor?, origin);
        let at_zero = |(r, run): (usize, &Sampled)| z[of(r)] * Complex::cis(-at * run.origin);
        let z = runs.iter().enumerate().map(at_zero).collect();
        variances.iter().all(|v| v.is_finite()).then_some(Self { at, z, variances })
    }
}

/// The samples that count: derivatives by real and imaginary part of `z` and by the beat, and the residual.
fn rows<'a>(
    run: &'a Sampled,
    wave: &'a Wave,
    z: Complex<f64>,
) -> impl Iterator<Item = ([f64; 3], f64)> + 'a {
    let samples = run.left.iter().zip(run.counts).zip(wave.values.iter().zip(&wave.slopes));
    samples.filter(|((_, counts), _)| **counts).map(move |((left, _), (value, slope))| {
        let row = [value.re, -value.im, (Complex::<f64>::i() * z * slope).re];
        (row, left - (z * value).re)
    })
}

/// Variances of the mean amplitude, the beat and the phase at beat zero.
fn variances(z: &[Complex<f64>], normal: &ArrowFactor, origin: f64) -> [f64; 3] {
    let last = 2 * z.len();
    let (mut amplitude, mut phase) = (DVector::zeros(last + 1), DVector::zeros(last + 1));
    let mut beat = DVector::zeros(last + 1);
    beat[last] = 1.0;
    for (s, z) in z.iter().enumerate() {
        let unit = z / (z.norm().max(f64::MIN_POSITIVE) * (0.5 * last as f64));
        let turned = Complex::<f64>::i() * unit / z.norm().max(f64::MIN_POSITIVE);
        (amplitude[2 * s], amplitude[2 * s + 1]) = (unit.re, unit.im);
        (phase[2 * s], phase[2 * s + 1]) = (turned.re, turned.im);
    }
    phase[last] = -origin;
    let of = [amplitude, beat, phase];
    let [by_amplitude, by_beat, by_phase] = normal.inverse_times(&of);
    [by_amplitude.dot(&of[0]), by_beat.dot(&of[1]), by_phase.dot(&of[2])]
}

#[cfg(test)]
mod tests {
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    use super::*;

    /// The sine itself, without a low-pass.
    fn wave(beat: &[f64]) -> impl Fn(usize, f64, f64) -> Wave + '_ {
        move |_, at, origin| {
            let values: Vec<_> = beat.iter().map(|b| Complex::cis(at * (b - origin))).collect();
            let slopes = beat.iter().zip(&values).map(|(b, v)| v * (b - origin)).collect();
            Wave { values, slopes }
        }
    }

    /// White noise of variance 1/12.
    fn noise(samples: usize, seed: u64) -> Vec<f64> {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        (0..samples).map(|_| rng.random::<f64>() - 0.5).collect()
    }

    /// A joint that swings stands at its ends, and its phase with it.
    #[test]
    fn oracle_a_ripple_of_a_joint_that_swings_has_its_own_size() {
        let beat: Vec<f64> = (0..4000).map(|t| 0.2 + 0.5 * (0.002 * f64::from(t)).sin()).collect();
        let (z, at) = (Complex::from_polar(0.7, 0.4), 61.03);
        let left: Vec<f64> = beat.iter().map(|b| (z * Complex::cis(at * b)).re).collect();
        let counts = vec![true; beat.len()];
        let run = Sampled { left: &left, counts: &counts, origin: 0.25 };
        let fit = ToneFit::new(&[run], Coherence::AllRuns, [61.0, 1.0], wave(&beat)).unwrap();
        assert!((fit.at - at).abs() < 1e-9, "{}", fit.at);
        assert!((fit.z[0] - z).norm() < 1e-9, "{}", fit.z[0]);
    }

    /// Of a sine over `n` samples from time zero on in noise of variance `v`, the variances are
    ///
    /// ```text
    /// amplitude: 2 v / n,   frequency: 24 v / (z² n³),   phase at time zero: 8 v / (z² n)
    /// ```
    ///
    /// (Kay 1993, section 3.11), the last four times that of a known frequency.
    #[test]
    fn oracle_of_a_line_the_variances_are_the_least_that_can_be() {
        let (samples, at, amplitude, phase, v) = (2000, 0.7, 1.5, 0.3, 1.0 / 12.0);
        let beat: Vec<f64> = (0..samples).map(f64::from).collect();
        let n = f64::from(samples);
        let expected = [
            2.0 * v / n,
            24.0 * v / (amplitude * amplitude * n.powi(3)),
            8.0 * v / (amplitude * amplitude * n),
        ];
        let counts = vec![true; beat.len()];
        let mut squares = [0.0; 3];
        let seeds = 200;
        for seed in 0..seeds {
            let drawn = noise(beat.len(), seed);
            let line = beat.iter().map(|b| amplitude * (at * b + phase).cos());
            let left: Vec<f64> = line.zip(&drawn).map(|(x, e)| x + e).collect();
            let run = Sampled { left: &left, counts: &counts, origin: 0.5 * n };
            let fit =
                ToneFit::new(&[run], Coherence::EachRun, [at + 1e-4, 1e-3], wave(&beat)).unwrap();
            let z = fit.z[0];
            let errors = [z.norm() - amplitude, fit.at - at, z.arg() - phase];
            squares.iter_mut().zip(errors).for_each(|(s, e)| *s += e * e / seeds as f64);
            for (found, expected) in fit.variances.iter().zip(expected) {
                // The amplitude is known to 0.6 per cent, and its square is in them.
                assert!((v * found / expected - 1.0).abs() < 0.05, "{} for {expected}", v * found);
            }
        }
        for (found, expected) in squares.iter().zip(expected) {
            assert!((found / expected - 1.0).abs() < 0.3, "{found} for {expected}");
        }
    }

    #[test]
    fn nothing_is_determined_by_no_samples() {
        let beat = [0.0, 1.0, 2.0];
        let run = Sampled { left: &[1.0; 3], counts: &[false; 3], origin: 0.0 };
        assert!(ToneFit::new(&[run], Coherence::AllRuns, [1.0, 0.1], wave(&beat)).is_none());
    }
}
