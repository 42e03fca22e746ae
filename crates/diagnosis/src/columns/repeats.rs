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
    let mut motion: Vec<usize> = Vec::new();
    for (r, run) in design.runs.iter().enumerate() {
        let earlier = (0..r).find(|&e| repeat_shift(design, &design.runs[e], run).is_some());
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
    let norm = |v: &[f64]| v.iter().map(|v| v * v).sum::<f64>().sqrt();
    let likeness = |a: &[Vec<f64>], b: &[Vec<f64>]| {
        let of_joint = |(a, b): (&Vec<f64>, &Vec<f64>)| {
            let product: f64 = a.iter().zip(b).map(|(a, b)| a * b).sum();
            product / (norm(a) * norm(b)).max(f64::MIN_POSITIVE)
        };
        a.iter().zip(b).map(of_joint).sum::<f64>() / a.len().max(1) as f64
    };
    let least = design.thresholds.one_spectrum;
    let mut pairs =
        spectra.iter().enumerate().flat_map(|(k, a)| spectra[k + 1..].iter().map(move |b| (a, b)));
    pairs.all(|(a, b)| likeness(a, b) > least)
}

/// `|V|` of every joint that moved, `[run][joint][frequency]`, all at the same frequencies.
fn velocity_spectra(design: Runs) -> Vec<Vec<Vec<f64>>> {
    let longest = design.runs.iter().map(|run| run.time.len()).max().unwrap_or(0);
    let size = (2 * longest).next_power_of_two();
    let mut fourier = FourierTransform::default();
    let mut spectrum = |qd: &[f64]| -> Vec<f64> {
        let mean = qd.iter().sum::<f64>() / qd.len().max(1) as f64;
        let window = |t: usize| 0.5 - 0.5 * (TAU * t as f64 / qd.len() as f64).cos();
        let mut padded: Vec<f64> =
            qd.iter().enumerate().map(|(t, v)| (v - mean) * window(t)).collect();
        padded.resize(size, 0.0);
        fourier.of(&mut padded).iter().map(|v| v.norm()).collect()
    };
    let mut of_run = |run: &RunDesign| -> Vec<Vec<f64>> {
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
    for (a, first) in design.runs.iter().enumerate() {
        for second in &design.runs[a + 1..] {
            let Some(shift) = repeat_shift(design, first, second) else { continue };
            let pairs = overlap(first.time.len(), second.time.len(), shift);
            repeat |= !pairs.is_empty();
            for j in 0..joints {
                let of = |run: &RunDesign| run.joints[j].residual().collect::<Vec<_>>();
                let (x, y) = (of(first), of(second));
                let both = |(s, t): &&(usize, usize)| {
                    first.joints[j].is_informative[*s] && second.joints[j].is_informative[*t]
                };
                for &(s, t) in pairs.iter().filter(both) {
                    sum[j] += (x[s] - y[t]).powi(2);
                    count[j] += 1;
                }
            }
        }
    }
    let rms = |(sum, count): (&f64, &usize)| (0.5 * sum / (*count).max(1) as f64).sqrt();
    repeat.then(|| sum.iter().zip(&count).map(rms).collect())
}

/// The shift (samples) at which the second run repeats the first, if it does.
fn repeat_shift(design: Runs, first: &RunDesign, second: &RunDesign) -> Option<isize> {
    let reach = (design.thresholds.repeat_shift_s * design.rate_hz).round() as isize;
    let moving_joints = || (0..design.moved.len()).filter(|&j| design.moved[j]);
    let mismatch = |shift: isize| {
        let pairs = overlap(first.time.len(), second.time.len(), shift);
        if 2 * pairs.len() < first.time.len().max(second.time.len()) {
            return f64::INFINITY;
        }
        let of_joint = |j: usize| {
            let (x, y) = (&first.joints[j].state[0], &second.joints[j].state[0]);
            let power: f64 = pairs.iter().map(|&(s, t)| (x[s] - y[t]).powi(2)).sum();
            let (low, high) = x
                .iter()
                .fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(*v), h.max(*v)));
            (power / pairs.len() as f64).sqrt() / (high - low).max(f64::MIN_POSITIVE)
        };
        moving_joints().map(of_joint).fold(0.0, f64::max)
    };
    let best = (-reach..=reach).map(|s| (mismatch(s), s)).min_by(|a, b| a.0.total_cmp(&b.0))?;
    (best.0 < design.thresholds.repeat_difference).then_some(best.1)
}

/// Pairs of samples of two runs that coincide when the second starts `shift` samples late.
fn overlap(first: usize, second: usize, shift: isize) -> Vec<(usize, usize)> {
    (0..first)
        .filter_map(|s| s.checked_add_signed(shift).filter(|&t| t < second).map(|t| (s, t)))
        .collect()
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
