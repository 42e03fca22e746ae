/// Half of the time over which a derivative is taken (s).
const HALF_S: f64 = 0.02;

/// Samples in half the time over which a derivative is taken, at least one.
pub(super) fn half(time: &[f64]) -> usize {
    let n = time.len();
    if n < 2 {
        return 1;
    }
    let period = (time[n - 1] - time[0]) / (n - 1) as f64;
    ((HALF_S / period).round() as usize).max(1)
}

/// Velocity as the slope of a chord over the samples of 20 ms either side, fewer at the ends:
///
/// ```text
/// qd[i] = (q[i + h] - q[i - h]) / (t[i + h] - t[i - h])
/// ```
pub(super) fn velocity(time: &[f64], q: &[f64]) -> Vec<f64> {
    if q.len() < 2 {
        return vec![0.0; q.len()];
    }
    let (half, last) = (half(time), q.len() - 1);
    let slope = |i: usize| {
        let (a, b) = (i.saturating_sub(half), (i + half).min(last));
        (q[b] - q[a]) / (time[b] - time[a])
    };
    (0..q.len()).map(slope).collect()
}

/// Second derivative from three samples 20 ms apart, from the nearest such three at the ends; 0 where
/// there are none:
///
/// ```text
/// x''[i] = 2 ((x[i + h] - x[i]) / (t[i + h] - t[i]) - (x[i] - x[i - h]) / (t[i] - t[i - h]))
///          / (t[i + h] - t[i - h])
/// ```
pub(super) fn acceleration(time: &[f64], x: &[f64]) -> Vec<f64> {
    let (half, n) = (half(time), x.len());
    if n < 2 * half + 1 {
        return vec![0.0; n];
    }
    let curve = |i: usize| {
        let i = i.clamp(half, n - 1 - half);
        let (a, b) = (i - half, i + half);
        let after = (x[b] - x[i]) / (time[b] - time[i]);
        let before = (x[i] - x[a]) / (time[i] - time[a]);
        2.0 * (after - before) / (time[b] - time[a])
    };
    (0..n).map(curve).collect()
}

/// Means over the samples of 20 ms either side, fewer at the ends.
pub(super) fn average(time: &[f64], x: &[f64]) -> Vec<f64> {
    let (most, last) = (half(time), x.len().saturating_sub(1));
    let mean = |i: usize| {
        let half = most.min(i).min(last - i);
        let part = &x[i - half..=i + half];
        part.iter().sum::<f64>() / part.len() as f64
    };
    (0..x.len()).map(mean).collect()
}

/// Signal at another time, linear between samples and held before the first and after the last.
pub(super) fn at(time: &[f64], x: &[f64], t: f64) -> f64 {
    let after = time.partition_point(|s| *s <= t);
    match (after.checked_sub(1), after < time.len()) {
        (None, _) => x.first().copied().unwrap_or(0.0),
        (Some(before), false) => x[before],
        (Some(before), true) => {
            let share = (t - time[before]) / (time[after] - time[before]);
            x[before] + share * (x[after] - x[before])
        }
    }
}

/// Root of the mean square; 0 of nothing.
pub(super) fn rms<'a>(values: impl Iterator<Item = &'a f64>) -> f64 {
    let (n, sum) = values.fold((0usize, 0.0), |(n, sum), x| (n + 1, sum + x * x));
    if n == 0 { 0.0 } else { (sum / n as f64).sqrt() }
}
