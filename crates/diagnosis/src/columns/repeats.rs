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
