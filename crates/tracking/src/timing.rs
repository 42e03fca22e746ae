/// Timing of the predictions and the ticks of a run.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Timing {
    /// Ticks that found no newer prediction than the one before.
    pub updates_missed: usize,
    /// Measured timing of a run in wall-clock time.
    pub wall: Option<WallClockTiming>,
}

/// Timing that was measured in wall-clock time.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct WallClockTiming {
    /// Predictions made during the run.
    pub predictions: usize,
    /// Time from the tick that asks to the prediction (s), over those predictions.
    pub latency: Latency,
    /// Ticks that began later than a period after they should.
    pub deadlines_missed: usize,
    /// Share of those among all ticks.
    pub deadlines_missed_share: f64,
    /// By how much the latest tick was late (s).
    pub latest_s: f64,
    /// Share of ticks that began later than a tenth of a period after they should.
    pub late_share: f64,
}

/// How long something took (s).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Latency {
    /// Half of the times are shorter.
    pub median_s: f64,
    /// 99 % of the times are shorter.
    pub p99_s: f64,
    /// The longest.
    pub max_s: f64,
}

impl Latency {
    /// The order statistics of some times (s); zeros without any.
    pub(crate) fn of(times_s: &[f64]) -> Self {
        let mut sorted = times_s.to_vec();
        sorted.sort_unstable_by(f64::total_cmp);
        let last = sorted.len().saturating_sub(1);
        let at = |share: f64| {
            let index = (share * last as f64).ceil() as usize;
            sorted.get(index).copied().unwrap_or_default()
        };
        Self { median_s: at(0.5), p99_s: at(0.99), max_s: at(1.0) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_latency_is_the_middle_and_the_end_of_the_sorted_times() {
        let times: Vec<f64> = (0..=100).rev().map(f64::from).collect();
        let expected = Latency { median_s: 50.0, p99_s: 99.0, max_s: 100.0 };
        assert_eq!(Latency::of(&times), expected);
        assert_eq!(Latency::of(&[]), Latency::default());
    }
}
