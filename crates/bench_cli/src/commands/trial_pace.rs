use std::time::Duration;

/// How long trials have taken so far.
#[derive(Debug, Clone, Copy, Default)]
pub struct TrialPace {
    made: u32,
    took: Duration,
}

impl TrialPace {
    /// One more is made.
    pub fn add(&mut self, took: Duration) {
        self.made += 1;
        self.took += took;
    }

    /// The time in which `left` trials are made, so many at a time:
    ///
    /// ```text
    /// mean time of a trial * ceil(left / jobs)
    /// ```
    ///
    /// none before as many are made as are made at a time: the first to end are the shortest.
    pub fn time_left(&self, left: usize, jobs: usize) -> Option<Duration> {
        let known = self.made as usize >= jobs && self.made > 0;
        let rounds = u32::try_from(left.div_ceil(jobs.max(1))).ok()?;
        known.then(|| (self.took / self.made).saturating_mul(rounds))
    }
}

/// A time to wait in the unit that a person counts it in: `40 s`, `12 min`, `3.5 h`.
pub fn words(time: Duration) -> String {
    match time.as_secs_f64() {
        s if s < 90.0 => format!("{s:.0} s"),
        s if s < 90.0 * 60.0 => format!("{:.0} min", s / 60.0),
        s => format!("{:.1} h", s / 3600.0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_left_takes_as_long_as_what_is_made() {
        let mut pace = TrialPace::default();
        assert_eq!(pace.time_left(10, 2), None);
        pace.add(Duration::from_secs(10));
        assert_eq!(
            (pace.time_left(10, 2), pace.time_left(10, 1)),
            (None, Some(Duration::from_secs(100)))
        );
        pace.add(Duration::from_secs(20));
        assert_eq!(pace.time_left(10, 2), Some(Duration::from_secs(75)));
        assert_eq!(pace.time_left(1, 2), Some(Duration::from_secs(15)));
        assert_eq!(pace.time_left(0, 2), Some(Duration::ZERO));
    }

    #[test]
    fn a_time_has_the_unit_it_is_counted_in() {
        let times = [3.2, 89.0, 90.0, 5399.0, 5400.0, 36_000.0];
        let words = times.map(|s| words(Duration::from_secs_f64(s)));
        assert_eq!(words, ["3 s", "89 s", "2 min", "90 min", "1.5 h", "10.0 h"]);
    }
}
