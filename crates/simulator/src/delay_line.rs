use std::collections::VecDeque;

/// A delayed signal.
///
/// ```text
/// out(t) = in(t - delay), linear between samples
/// ```
///
/// Before its first sample the signal had the value of that sample.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct DelayLine {
    delay_s: f64,
    /// Times (s) and values: the last sample at or before the time asked for, and all later ones.
    past: VecDeque<(f64, f64)>,
}

impl DelayLine {
    pub fn new(delay_s: f64) -> Self {
        Self { delay_s, past: VecDeque::new() }
    }

    /// Discards the signal.
    pub fn clear(&mut self) {
        self.past.clear();
    }

    /// Adds the value at `time_s`, which must be later than all before, and returns the delayed value.
    pub fn pass(&mut self, time_s: f64, value: f64) -> f64 {
        self.past.push_back((time_s, value));
        let asked = time_s - self.delay_s;
        while self.past.get(1).is_some_and(|&(time, _)| time <= asked) {
            self.past.pop_front();
        }
        match (self.past.front(), self.past.get(1)) {
            (Some(&(t0, v0)), Some(&(t1, v1))) if asked > t0 => {
                v0 + (v1 - v0) * (asked - t0) / (t1 - t0)
            }
            (first, _) => first.map_or(value, |&(_, v0)| v0),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A ramp of slope 2 that starts at 1, sampled unevenly.
    #[test]
    fn a_ramp_comes_later_by_any_delay_and_holds_before_its_start() {
        for delay_s in [0.0, 0.3, 1.0, 2.45] {
            let mut line = DelayLine::new(delay_s);
            for time_s in [0.0, 1.0, 1.5, 3.0, 4.0, 4.25, 7.0] {
                let expected = 1.0 + 2.0 * (time_s - delay_s).max(0.0);
                let found = line.pass(time_s, 1.0 + 2.0 * time_s);
                assert!((found - expected).abs() < 1e-12, "{delay_s} s at {time_s} s: {found}");
            }
        }
    }
}
