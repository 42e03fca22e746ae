/// Rows of a log long enough for its clock to be judged.
const FEWEST: usize = 256;

/// Share of steps far from the mean step above which stamps count as times of arrival.
const IRREGULAR: f64 = 1.0 / 3.0;

/// An even clock that replaces time stamps of arrival.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct EvenClock {
    /// Time of every row (s).
    pub time: Vec<f64>,
    /// Its step (s).
    pub step_s: f64,
    /// Largest distance of a time stamp from the even clock (s).
    pub largest_s: f64,
}

/// The even clock behind time stamps that scatter by more than a step. `None` where the stamps are good, or where the
/// rows were not recorded at an even rate.
///
/// ```text
/// a third of the steps beyond 1/2 .. 3/2 of the mean step
/// sd(t[k+m] - t[k]) < sqrt(m) / 2 sd(t[k+1] - t[k]),   m = n / 8
/// ```
///
/// The second condition holds where delays do not add up from row to row. Rows at random times and lost rows fail it.
pub(crate) fn even_clock(time: &[f64]) -> Option<EvenClock> {
    let n = time.len();
    if n < FEWEST {
        return None;
    }
    let step_s = (time[n - 1] - time[0]) / (n - 1) as f64;
    let is_irregular = |t: &&[f64]| !(0.5..=1.5).contains(&((t[1] - t[0]) / step_s));
    let irregular = time.windows(2).filter(is_irregular).count();
    if (irregular as f64) < IRREGULAR * n as f64 {
        return None;
    }
    let m = n / 8;
    if spread(time, m, step_s) > 0.5 * (m as f64).sqrt() * spread(time, 1, step_s) {
        return None;
    }
    // The line of least squares through the stamps.
    let (middle, mean) = (0.5 * (n - 1) as f64, time.iter().sum::<f64>() / n as f64);
    let (mut kk, mut kt) = (0.0, 0.0);
    for (k, t) in time.iter().enumerate() {
        let k = k as f64 - middle;
        (kk, kt) = (kk + k * k, kt + k * (t - mean));
    }
    let step_s = kt / kk;
    let even: Vec<f64> = (0..n).map(|k| mean + step_s * (k as f64 - middle)).collect();
    let largest_s = even.iter().zip(time).fold(0.0_f64, |most, (a, b)| most.max((a - b).abs()));
    let rises = step_s > 0.0 && even.windows(2).all(|t| t[1] > t[0]);
    rises.then_some(EvenClock { time: even, step_s, largest_s })
}

/// Standard deviation of the time that `m` steps take (s). The mean is `m` mean steps.
fn spread(time: &[f64], m: usize, step_s: f64) -> f64 {
    let count = time.len().saturating_sub(m).max(1) as f64;
    let off = |(a, b): (&f64, &f64)| (b - a - m as f64 * step_s).powi(2);
    (time.iter().zip(&time[m.min(time.len())..]).map(off).sum::<f64>() / count).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Whole numbers that look drawn: a linear congruence.
    fn random_numbers() -> impl FnMut() -> f64 {
        let mut state = 1_u64;
        move || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1_u64 << 53) as f64
        }
    }

    fn sort(mut time: Vec<f64>) -> Vec<f64> {
        time.sort_unstable_by(f64::total_cmp);
        time
    }

    #[test]
    fn stamps_that_are_late_by_more_than_a_step_are_put_on_an_even_clock() {
        let mut number = random_numbers();
        let late = sort((0..5000).map(|k| 0.002 * f64::from(k) + 0.01 * number()).collect());
        let even = even_clock(&late).unwrap();
        assert!((even.step_s / 0.002 - 1.0).abs() < 1e-3 && even.largest_s < 0.01, "{even:?}");
        // The mean delay stays.
        assert!(
            even.time.iter().zip(0..).all(|(t, k)| (t - 0.002 * f64::from(k) - 0.005).abs() < 1e-3)
        );
    }

    #[test]
    fn stamps_that_can_be_believed_stay() {
        let mut number = random_numbers();
        let slightly: Vec<f64> =
            (0..5000).map(|k| 0.002 * f64::from(k) + 2e-4 * number()).collect();
        assert_eq!(even_clock(&slightly), None);
        let mut gap = sort((0..5000).map(|k| 0.002 * f64::from(k) + 0.01 * number()).collect());
        gap[2500..].iter_mut().for_each(|t| *t += 1.0);
        assert_eq!(even_clock(&gap), None);
        // Rows that come when they like.
        let mut now = 0.0;
        let mut next = || {
            now -= 0.002 * (1.0 - number()).ln();
            now
        };
        let poisson: Vec<f64> = (0..5000).map(|_| next()).collect();
        assert_eq!(even_clock(&poisson), None);
    }
}
