use logs::Run;

use crate::observation::{Observation, ObservationKind, RunStretch, Spoils};
use crate::pieces::usual_step;
use crate::thresholds::InspectionThresholds;

/// Quantile of the normal distribution: a tenth of all values are within so many standard deviations of zero.
const NORMAL_QUANTILE_55: f64 = 0.1257;

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
    let floor = least_height(position, t);
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

/// The share of single rows of a position that are off, where they are too frequent to be bridged.
///
/// ```text
/// d[k] = q[k] - (q[k-1] + q[k+1]) / 2,   |d[k]| > spike_over_noise sigma,   sigma = q_0.1(|d|) / z_0.55
/// ```
///
/// Up to a share of half, a tenth of the rows and their neighbours are free of spikes. Their distances give the noise
/// `sigma`, at half ten times too large. The neighbours of a spike are off in the other direction, those of a turn of the
/// motion in the same. Those of a value that is held are no nearer to one another than to it.
pub(crate) fn frequent_spikes(
    run: &Run,
    index: usize,
    joint: usize,
    position: &[f64],
    t: &InspectionThresholds,
) -> Option<Observation> {
    let n = position.len();
    if n < t.moments.rare_spike {
        return None;
    }
    let (gap, usual) = (t.moments.gap, usual_step(&run.time));
    let d: Vec<f64> =
        (0..n).map(|k| signed_off(&run.time, position, gap * usual, usual, k)).collect();
    let mut sorted: Vec<f64> = d.iter().map(|d| d.abs()).collect();
    sorted.sort_unstable_by(f64::total_cmp);
    let noise = sorted[n / 10] / NORMAL_QUANTILE_55;
    let least = (t.moments.spike_over_noise * noise).max(least_height(position, t));
    let returns = |k: usize| {
        let (before, after) = (position[k - 1], position[k + 1]);
        (after - before).abs() < 0.5 * d[k].abs()
            && [d[k - 1], d[k + 1]]
                .iter()
                .all(|beside| beside * d[k] < t.moments.beside_spike * d[k] * d[k])
    };
    let found: Vec<usize> = (1..n - 1).filter(|&k| d[k].abs() > least && returns(k)).collect();
    if found.len() <= n / t.moments.rare_spike {
        return None;
    }
    let height = found.iter().fold(0.0_f64, |most, &k| most.max(d[k].abs()));
    let kind = ObservationKind::FrequentSpikes { share: found.len() as f64 / n as f64, height };
    Some(Observation::of_runs(kind, vec![joint], vec![index], Spoils::Everything))
}

/// Least height of a spike (rad or m): some steps of the encoder, and what low-passes handle.
fn least_height(position: &[f64], t: &InspectionThresholds) -> f64 {
    let steps = position.windows(2).map(|q| (q[1] - q[0]).abs()).filter(|step| *step > 0.0);
    (t.moments.spike_counts * steps.fold(f64::INFINITY, f64::min)).max(t.moments.least_spike)
}

/// Distance of a row from the line through its neighbours; 0 beside a gap.
fn off(time: &[f64], q: &[f64], gap: f64, usual: f64, k: usize) -> f64 {
    signed_off(time, q, gap, usual, k).abs()
}

/// The same with its sign.
fn signed_off(time: &[f64], q: &[f64], gap: f64, usual: f64, k: usize) -> f64 {
    if k == 0 || k + 1 >= q.len() || time[k + 1] - time[k - 1] > gap {
        return 0.0;
    }
    // Whole steps: stamps with jitter say nothing of when a row was read.
    let [before, after] =
        [time[k] - time[k - 1], time[k + 1] - time[k]].map(|t| (t / usual).round().max(1.0));
    let share = before / (before + after);
    q[k] - q[k - 1] - share * (q[k + 1] - q[k - 1])
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

    /// A number for a row that says nothing of its neighbours' (SplitMix64).
    fn scattered(row: usize) -> usize {
        let z = (row as u64 + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        let z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        ((z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb) >> 33) as usize
    }

    /// From one row in fifty to every other one; the same rows off by less than the noise, a turn of the motion, values
    /// that are held and an encoder of few counts are none.
    #[test]
    fn frequent_single_rows_are_told_at_any_share() {
        let (run, t) = (swing(0.3), InspectionThresholds::default());
        let clean = &run.joints[0].position;
        let told = |q: &[f64]| frequent_spikes(&run, 0, 0, q, &t).map(|o| o.kind);
        assert_eq!(told(clean), None);
        for every in [2, 3, 10, 50] {
            let hit = |k: usize| scattered(k).is_multiple_of(every);
            let spoilt = |height: f64| -> Vec<f64> {
                let side = |k: usize| if scattered(k) & 256 == 0 { height } else { -height };
                let rows = clean.iter().enumerate();
                rows.map(|(k, q)| if hit(k) { q + side(k) } else { *q }).collect()
            };
            let found = told(&spoilt(0.05));
            assert!(matches!(found, Some(ObservationKind::FrequentSpikes { .. })), "{every}");
            assert_eq!(told(&spoilt(1e-3)), None);
        }
        let held: Vec<f64> = (0..clean.len()).map(|k| clean[k - k % 5]).collect();
        assert_eq!(told(&held), None);
        let coarse: Vec<f64> = clean.iter().map(|q| (q / 0.01).round() * 0.01).collect();
        assert_eq!(told(&coarse), None);
    }
}
