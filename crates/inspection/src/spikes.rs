use logs::Run;

use crate::observation::{Observation, ObservationKind, RunStretch};
use crate::pieces::usual_step;
use crate::thresholds::InspectionThresholds;

/// Single rows of a position that are off, which are bridged.
///
/// ```text
/// off[k] = |q[k] - (q[k-1] + q[k+1]) / 2|   against the largest of its neighbourhood without the spikes
/// ```
pub(crate) fn spikes(
    run: &Run,
    index: usize,
    joint: usize,
    position: &mut [f64],
    t: &InspectionThresholds,
) -> Option<Observation> {
    let usual = usual_step(&run.time);
    let n = position.len();
    if n < t.moments.rare_spike {
        return None;
    }
    let off: Vec<f64> =
        (0..n).map(|k| off(&run.time, position, t.moments.gap * usual, usual, k)).collect();
    // A spike makes its neighbours' half as large: the largest of all without the spikes and them is usual.
    let mut sorted = off.clone();
    sorted.sort_unstable_by(f64::total_cmp);
    let bulk = sorted[n - 1 - n / t.moments.bulk_of_rows];
    let steps = position.windows(2).map(|q| (q[1] - q[0]).abs()).filter(|step| *step > 0.0);
    let floor =
        (t.moments.spike_counts * steps.fold(f64::INFINITY, f64::min)).max(t.moments.least_spike);
    let is_spike = |k: &usize| {
        off[*k] > t.moments.spike * bulk && off[*k] > floor && alone(&off, *k, t.moments.single)
    };
    let found: Vec<usize> = (1..n - 1).filter(is_spike).collect();
    let usual_off = (0..n)
        .filter(|k| found.iter().all(|f| f.abs_diff(*k) > 1))
        .fold(0.0_f64, |most, k| most.max(off[k]));
    let height = found.iter().fold(0.0_f64, |most, &k| most.max(off[k]));
    let least = found.iter().fold(f64::INFINITY, |least, &k| least.min(off[k]));
    if found.is_empty()
        || found.len() > n / t.moments.rare_spike
        || least < 0.5 * t.moments.spike * usual_off
    {
        return None;
    }
    for &k in &found {
        position[k] = 0.5 * (position[k - 1] + position[k + 1]);
    }
    let rows = found.iter().map(|&k| RunStretch::of_rows(run, index, &(k..k + 1))).collect();
    Some(Observation::of_seconds(
        ObservationKind::Spikes { count: found.len(), height },
        joint,
        rows,
    ))
}

/// Distance of a row from the line through its neighbours; 0 beside a gap.
fn off(time: &[f64], q: &[f64], gap: f64, usual: f64, k: usize) -> f64 {
    if k == 0 || k + 1 >= q.len() || time[k + 1] - time[k - 1] > gap {
        return 0.0;
    }
    // Whole steps: stamps with jitter say nothing of when a row was read.
    let [before, after] =
        [time[k] - time[k - 1], time[k + 1] - time[k]].map(|t| (t / usual).round().max(1.0));
    let share = before / (before + after);
    (q[k] - q[k - 1] - share * (q[k + 1] - q[k - 1])).abs()
}

/// Whether both neighbours are off by half as much: the mark of a single row.
fn alone(off: &[f64], k: usize, nearly: f64) -> bool {
    let half = 0.5 * off[k];
    let near = |x: f64| (x - half).abs() < nearly * half;
    near(off[k - 1]) && near(off[k + 1])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::swing;

    #[test]
    fn single_rows_are_told_and_bridged_and_a_swing_is_left_alone() {
        let (mut run, t) = (swing(0.3), InspectionThresholds::default());
        let clean = run.joints[0].position.clone();
        let mut q = clean.clone();
        assert_eq!(spikes(&run, 0, 0, &mut q, &t), None);
        [700, 1900, 4000].iter().for_each(|&k| q[k] += 0.05);
        run.joints[0].position.clone_from(&q);
        let found = spikes(&run, 0, 0, &mut q, &t).unwrap();
        assert!(matches!(found.kind, ObservationKind::Spikes { count: 3, .. }), "{found:?}");
        assert!(q.iter().zip(&clean).all(|(a, b)| (a - b).abs() < 1e-3));
    }
}
