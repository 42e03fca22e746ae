use std::f64::consts::TAU;

use logs::FourierTransform;

use crate::columns::run_design::RunDesign;
use crate::thresholds::signals::SignalThresholds;

/// Runs of which some may repeat a motion.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Runs<'a> {
    pub runs: &'a [RunDesign],
    /// Rate of the samples (Hz).
    pub rate_hz: f64,
    /// Joints that moved.
    pub moved: &'a [bool],
    pub thresholds: &'a SignalThresholds,
}

/// Numbers the motions: a run that repeats an earlier run gets the number of that run.
pub(crate) fn motions(design: Runs) -> Vec<usize> {
    let paths = design.paths();
    let mut motion: Vec<usize> = Vec::new();
    for (r, path) in paths.iter().enumerate() {
        let earlier = paths[..r].iter().position(|of| design.repeat_shift(of, path).is_some());
        motion.push(earlier.map_or(r, |e| motion[e]));
    }
    motion
}

/// Whether all runs move at the same frequencies, whatever their phases: any function of such a motion then has the same
/// lines in every run. The likeness of two runs is
///
/// ```text
/// mean over joints of  sum_f |V_a| |V_b| / sqrt(sum_f |V_a|² sum_f |V_b|²)
/// ```
///
/// with the transforms `V` of the velocities in a Hann window. It is 1 for equal spectra.
pub(crate) fn have_one_spectrum(design: Runs) -> bool {
    let spectra = velocity_spectra(design);
    let likeness = |a: &[Spectrum], b: &[Spectrum]| {
        let of_joint = |(a, b): (&Spectrum, &Spectrum)| {
            let product: f64 = a.lines.iter().zip(&b.lines).map(|(a, b)| a * b).sum();
            product / (a.norm * b.norm).max(f64::MIN_POSITIVE)
        };
        a.iter().zip(b).map(of_joint).sum::<f64>() / a.len().max(1) as f64
    };
    let least = design.thresholds.one_spectrum;
    let mut pairs =
        spectra.iter().enumerate().flat_map(|(k, a)| spectra[k + 1..].iter().map(move |b| (a, b)));
    pairs.all(|(a, b)| likeness(a, b) > least)
}

/// The spectrum of a velocity.
struct Spectrum {
    /// `|V|` by frequency.
    lines: Vec<f64>,
    /// `sqrt(sum |V|²)`.
    norm: f64,
}

/// The spectra of the joints that moved, `[run][joint]`, all at the same frequencies.
fn velocity_spectra(design: Runs) -> Vec<Vec<Spectrum>> {
    let longest = design.runs.iter().map(|run| run.time.len()).max().unwrap_or(0);
    let size = (2 * longest).next_power_of_two();
    let mut fourier = FourierTransform::default();
    let mut spectrum = |qd: &[f64]| -> Spectrum {
        let mean = qd.iter().sum::<f64>() / qd.len().max(1) as f64;
        let window = |t: usize| 0.5 - 0.5 * (TAU * t as f64 / qd.len() as f64).cos();
        let mut padded: Vec<f64> =
            qd.iter().enumerate().map(|(t, v)| (v - mean) * window(t)).collect();
        padded.resize(size, 0.0);
        let lines: Vec<f64> = fourier.of(&mut padded).iter().map(|v| v.norm()).collect();
        let norm = lines.iter().map(|v| v * v).sum::<f64>().sqrt();
        Spectrum { lines, norm }
    };
    let mut of_run = |run: &RunDesign| -> Vec<Spectrum> {
        let joints = run.joints.iter().zip(design.moved).filter(|(_, moved)| **moved);
        joints.map(|(joint, _)| spectrum(&joint.state[1])).collect()
    };
    design.runs.iter().map(&mut of_run).collect()
}

/// Noise of every joint from runs that repeat a motion: `sqrt(mean((r_a - r_b)^2) / 2)` over all pairs of these runs
/// and all samples that are informative in both. `r` is the residual of the nominal model, so that small differences
/// of the motion cancel.
pub(crate) fn noise_of_repeats(design: Runs) -> Option<Vec<f64>> {
    let joints = design.moved.len();
    let (mut sum, mut count) = (vec![0.0; joints], vec![0_usize; joints]);
    let mut repeat = false;
    let (paths, residuals) = (design.paths(), design.residuals());
    for (a, first) in design.runs.iter().enumerate() {
        for (b, second) in design.runs.iter().enumerate().skip(a + 1) {
            let Some(shift) = design.repeat_shift(&paths[a], &paths[b]) else { continue };
            let pairs = || overlap(first.time.len(), second.time.len(), shift);
            repeat |= pairs().next().is_some();
            for j in 0..joints {
                let (x, y) = (&residuals[a][j], &residuals[b][j]);
                let both = |(s, t): &(usize, usize)| {
                    first.joints[j].is_informative[*s] && second.joints[j].is_informative[*t]
                };
                for (s, t) in pairs().filter(both) {
                    sum[j] += (x[s] - y[t]).powi(2);
                    count[j] += 1;
                }
            }
        }
    }
    let rms = |(sum, count): (&f64, &usize)| (0.5 * sum / (*count).max(1) as f64).sqrt();
    repeat.then(|| sum.iter().zip(&count).map(rms).collect())
}

/// Positions of the joints that moved in a run, and the range of each.
struct Path<'a> {
    samples: usize,
    joints: Vec<(&'a [f64], f64)>,
}

impl Path<'_> {
    /// RMS difference of the positions from those of another run that starts `shift` samples late, as a share of the
    /// range, of the joint where it is largest; `None` where it is `limit` or more, or the runs have less than half in
    /// common.
    ///
    /// A sum of squares only grows: it ends where it is beyond the limit, and a few samples of the whole run are asked
    /// before all of them.
    fn mismatch_below(&self, other: &Self, shift: isize, limit: f64) -> Option<f64> {
        /// Samples that are asked first, spread evenly.
        const FEW: usize = 16;
        /// Samples between two looks at the sum.
        const PIECE: usize = 64;
        /// Above what rounding makes of a sum.
        const ROUNDING: f64 = 1.0 + 1e-9;
        let begin = shift.min(0).unsigned_abs();
        // Counted by its ends: this is asked of every pair of runs at every shift.
        let pairs = overlap(self.samples, other.samples, shift).len();
        if pairs == 0 || 2 * pairs < self.samples.max(other.samples) {
            return None;
        }
        let mut largest = 0.0_f64;
        for ((x, range), (y, _)) in self.joints.iter().zip(&other.joints) {
            let x = &x[begin..][..pairs];
            let y = &y[begin.checked_add_signed(shift)?..][..pairs];
            let range = range.max(f64::MIN_POSITIVE);
            let most = (limit * range).powi(2) * pairs as f64 * ROUNDING;
            let square = |(x, y): (&f64, &f64)| (x - y).powi(2);
            let step = pairs.div_ceil(FEW);
            let few = x.iter().step_by(step).zip(y.iter().step_by(step));
            few.map(square)
                .try_fold(0.0, |sum, square| Some(sum + square).filter(|s| *s <= most))?;
            let mut power = 0.0;
            for (x, y) in x.chunks(PIECE).zip(y.chunks(PIECE)) {
                power = x.iter().zip(y).map(square).fold(power, |sum, square| sum + square);
                if power > most {
                    return None;
                }
            }
            largest = largest.max((power / pairs as f64).sqrt() / range);
        }
        (largest < limit).then_some(largest)
    }
}

impl<'a> Runs<'a> {
    fn paths(self) -> Vec<Path<'a>> {
        let ends = |x: &[f64]| {
            x.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(*v), h.max(*v)))
        };
        let of_joint = |x: &'a [f64]| {
            let (low, high) = ends(x);
            (x, high - low)
        };
        let of_run = |run: &'a RunDesign| {
            let joints = run.joints.iter().zip(self.moved).filter(|(_, moved)| **moved);
            let joints = joints.map(|(joint, _)| of_joint(&joint.state[0])).collect();
            Path { samples: run.time.len(), joints }
        };
        self.runs.iter().map(of_run).collect()
    }

    /// Residuals of the nominal model, `[run][joint][sample]`.
    fn residuals(self) -> Vec<Vec<Vec<f64>>> {
        let of_run = |run: &RunDesign| run.joints.iter().map(|j| j.residual().collect()).collect();
        self.runs.iter().map(of_run).collect()
    }

    /// The shift (samples) at which the second run repeats the first, if it does.
    fn repeat_shift(self, first: &Path, second: &Path) -> Option<isize> {
        let reach = (self.thresholds.repeat_shift_s * self.rate_hz).round() as isize;
        let (mut least, mut best) = (self.thresholds.repeat_difference, None);
        for shift in -reach..=reach {
            if let Some(mismatch) = first.mismatch_below(second, shift, least) {
                (least, best) = (mismatch, Some(shift));
            }
        }
        best
    }
}

/// Pairs of samples of two runs that coincide when the second starts `shift` samples late.
fn overlap(
    first: usize,
    second: usize,
    shift: isize,
) -> impl ExactSizeIterator<Item = (usize, usize)> {
    let begin = shift.min(0).unsigned_abs();
    let end = first.min(second.saturating_add_signed(-shift));
    // From `begin` on, no sum is below zero.
    (begin..end).map(move |s| (s, s.saturating_add_signed(shift)))
}

#[cfg(test)]
mod tests {
    use nalgebra::DMatrix;

    use super::*;
    use crate::columns::run_design::JointDesign;

    /// A run of 20 s at 20 Hz of two joints with a sine each: frequencies (Hz) and one phase (rad).
    fn run(hz: [f64; 2], phase: f64) -> RunDesign {
        let time: Vec<f64> = (0..400).map(|t| 0.05 * f64::from(t)).collect();
        let joint = |hz: f64| JointDesign {
            x: DMatrix::zeros(0, 0),
            measured: Vec::new(),
            known: Vec::new(),
            nominal: Vec::new(),
            state: [0.0, TAU * hz, 0.0]
                .map(|size| time.iter().map(|t| size * (TAU * hz * t + phase).cos()).collect()),
            is_informative: Vec::new(),
            slides: Vec::new(),
        };
        RunDesign { name: String::new(), joints: hz.map(joint).to_vec(), time: time.clone() }
    }

    /// The same by the definition: of all shifts with half of the samples, the first of those with the least mismatch.
    fn shift_by_definition(design: Runs, first: &RunDesign, second: &RunDesign) -> Option<isize> {
        let mismatch = |shift: isize| {
            let of_joint = |(a, b): (&JointDesign, &JointDesign)| {
                let (x, y) = (&a.state[0], &b.state[0]);
                let at = |s: usize| Some((x[s] - y.get(s.checked_add_signed(shift)?)?).powi(2));
                let squares: Vec<f64> = (0..x.len()).filter_map(at).collect();
                let ends = x
                    .iter()
                    .fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], v| [l.min(*v), h.max(*v)]);
                let has_half = 2 * squares.len() >= x.len().max(y.len());
                let rms = (squares.iter().sum::<f64>() / squares.len() as f64).sqrt();
                if has_half { rms / (ends[1] - ends[0]) } else { f64::INFINITY }
            };
            first.joints.iter().zip(&second.joints).map(of_joint).fold(0.0, f64::max)
        };
        let best = (-20..=20).map(|s| (mismatch(s), s)).min_by(|a, b| a.0.total_cmp(&b.0))?;
        (best.0 < design.thresholds.repeat_difference).then_some(best.1)
    }

    #[test]
    fn the_shift_of_a_repeat_is_that_of_the_least_mismatch() {
        let mut runs: Vec<RunDesign> =
            [0.0, 0.05, -0.4, 1.9, 0.002].map(|phase| run([0.4, 0.7], phase)).to_vec();
        // The same motion some samples later, and a short one of which half is another's.
        let later = |by: usize, samples: usize| {
            let mut late = run([0.4, 0.7], 0.0);
            late.time.truncate(samples);
            late.joints.iter_mut().for_each(|j| {
                j.state[0].drain(..by);
                j.state[0].truncate(samples);
            });
            late
        };
        runs.extend([later(7, 390), later(20, 300), later(0, 199), later(25, 300)]);
        let thresholds = SignalThresholds::default();
        let design =
            Runs { runs: &runs, rate_hz: 20.0, moved: &[true; 2], thresholds: &thresholds };
        let paths = design.paths();
        let mut found = 0;
        for (a, first) in runs.iter().enumerate() {
            for (b, second) in runs.iter().enumerate() {
                let shift = design.repeat_shift(&paths[a], &paths[b]);
                assert_eq!(shift, shift_by_definition(design, first, second), "{a} {b}");
                found += usize::from(shift.is_some());
            }
        }
        assert!((runs.len() + 4..runs.len().pow(2)).contains(&found), "{found}");
    }

    fn alike(runs: &[RunDesign]) -> bool {
        let thresholds = SignalThresholds::default();
        have_one_spectrum(Runs { runs, rate_hz: 20.0, moved: &[true; 2], thresholds: &thresholds })
    }

    #[test]
    fn runs_of_the_same_frequencies_have_one_spectrum_whatever_their_phases() {
        let runs = [0.0, 0.9, 2.5].map(|phase| run([0.4, 0.7], phase));
        assert!(alike(&runs));
        let other = run([0.4, 0.9], 0.0);
        assert!(!alike(&[&runs[..], &[other]].concat()), "one run moves at another frequency");
    }
}
