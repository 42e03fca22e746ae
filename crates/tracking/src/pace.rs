use std::{
    hint, thread,
    time::{Duration, Instant},
};

use crate::timing::WallClockTiming;

/// How ticks follow one another.
#[derive(Debug)]
pub(crate) enum Pace {
    /// As soon as the machine lets them.
    Free,
    /// One a period on the clock on the wall.
    Wall(WallPace),
}

/// A schedule of ticks and how well it was kept.
///
/// ```text
/// due_{k+1} = due_k + T             while a tick is less than T late
/// due_{k+1} = start of tick k + T   after one that is later
/// ```
///
/// so that ticks never come in a burst to make up for others.
#[derive(Debug)]
pub(crate) struct WallPace {
    period: Duration,
    /// When the next tick should begin; none before the first.
    due: Option<Instant>,
    ticks: usize,
    missed: usize,
    late: usize,
    latest: Duration,
}

/// Last part of a wait, in which the thread spins: a sleeping thread wakes up to this much late.
const AWAKE: Duration = Duration::from_micros(200);

impl Pace {
    /// Waits until the next tick is due.
    pub fn wait(&mut self) {
        let Self::Wall(pace) = self else { return };
        if let Some(due) = pace.due {
            let left = due.saturating_duration_since(Instant::now());
            thread::sleep(left.saturating_sub(AWAKE));
            while Instant::now() < due {
                hint::spin_loop();
            }
        }
        pace.begin(Instant::now());
    }
}

impl WallPace {
    /// A schedule that starts with the first tick.
    pub fn new(period: Duration) -> Self {
        let latest = Duration::ZERO;
        Self { period, due: None, ticks: 0, missed: 0, late: 0, latest }
    }

    /// A tick begins.
    fn begin(&mut self, now: Instant) {
        let due = self.due.unwrap_or(now);
        let lateness = now.saturating_duration_since(due);
        self.ticks += 1;
        self.latest = self.latest.max(lateness);
        self.late += usize::from(lateness > self.period / 10);
        self.missed += usize::from(lateness > self.period);
        let from = if lateness > self.period { now } else { due };
        self.due = Some(from + self.period);
    }

    /// Timing of the schedule so far.
    pub fn timing(&self) -> WallClockTiming {
        let share = |count: usize| count as f64 / self.ticks.max(1) as f64;
        WallClockTiming {
            deadlines_missed: self.missed,
            deadlines_missed_share: share(self.missed),
            latest_s: self.latest.as_secs_f64(),
            late_share: share(self.late),
            ..WallClockTiming::default()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_schedule_is_kept_until_a_deadline_is_missed_and_then_begins_anew() {
        let ms = Duration::from_micros(1000);
        let mut pace = WallPace::new(2 * ms);
        let start = Instant::now();
        let mut due = |at: Duration| {
            pace.begin(start + at);
            (pace.due.unwrap() - start).as_millis()
        };
        assert_eq!(due(Duration::ZERO), 2);
        // 0.1 ms late is on time, 0.5 ms late is late, 3 ms late is a deadline missed.
        assert_eq!(due(2 * ms + ms / 10), 4);
        assert_eq!(due(4 * ms + ms / 2), 6);
        assert_eq!(due(9 * ms), 11);
        assert_eq!(due(11 * ms), 13);
        let timing = pace.timing();
        assert_eq!(timing.deadlines_missed, 1);
        let found = [timing.deadlines_missed_share, timing.late_share, timing.latest_s];
        for (found, expected) in found.into_iter().zip([0.2, 0.4, 0.003]) {
            assert!((found - expected).abs() < 1e-12, "{found} instead of {expected}");
        }
    }
}
