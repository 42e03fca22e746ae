use serde::Serialize;

/// 97.5th percentile of the normal distribution.
const Z: f64 = 1.959_963_984_540_054;

/// A count out of a number of cases, as an estimate for all possible cases.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Share {
    /// Number of cases that count.
    pub count: usize,
    /// Number of all cases.
    pub of: usize,
    /// 95 per cent score interval (Wilson 1927) for the share; `None` without cases:
    ///
    /// ```text
    /// (p + z²/2n ± z sqrt(p (1 - p) / n + z²/4n²)) / (1 + z²/n),   p = count / n, n = of
    /// ```
    pub interval: Option<[f64; 2]>,
}

impl Share {
    /// `count` of `of`.
    pub fn new(count: usize, of: usize) -> Self {
        Self { count, of, interval: (of > 0).then(|| wilson(count as f64, of as f64)) }
    }

    /// The share of the cases for which `is` holds.
    pub(crate) fn of<T>(all: &[T], is: impl Fn(&T) -> bool) -> Self {
        Self::new(all.iter().filter(|one| is(one)).count(), all.len())
    }

    /// Share and interval in per cent, such as `95 % 76-99`; `-` without cases.
    pub fn words(&self) -> String {
        let Some([low, high]) = self.interval else { return "-".to_owned() };
        let share = 100.0 * self.count as f64 / self.of as f64;
        format!("{share:.0} % {:.0}-{:.0}", 100.0 * low, 100.0 * high)
    }
}

/// The score interval of a share; the numbers may be fractions.
pub(crate) fn wilson(count: f64, n: f64) -> [f64; 2] {
    let (p, zz) = (count / n, Z * Z / n);
    let centre = p + 0.5 * zz;
    let half = Z * (p * (1.0 - p) / n + 0.25 * zz / n).sqrt();
    [centre - half, centre + half].map(|end| (end / (1.0 + zz)).clamp(0.0, 1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The ends `p` of the interval are where `count` is just `z` standard deviations off `n p`.
    #[test]
    fn the_ends_of_the_interval_solve_the_score_equation() {
        for (count, of) in [(0, 10), (1, 7), (19, 20), (340, 400), (10, 10)] {
            let [low, high] = Share::new(count, of).interval.unwrap();
            for p in [low, high] {
                let (n, off) = (of as f64, count as f64 - of as f64 * p);
                let expected = Z * Z * n * p * (1.0 - p);
                assert!((off * off - expected).abs() < 1e-9, "{count} of {of}: {p}");
            }
            assert!(
                low <= high && (count > 0 || low < 1e-12) && (count < of || high > 1.0 - 1e-12)
            );
        }
    }

    #[test]
    fn a_share_of_nothing_is_a_dash() {
        assert_eq!(Share::new(0, 0).words(), "-");
        assert_eq!(Share::new(19, 20).words(), "95 % 76-99");
    }
}
