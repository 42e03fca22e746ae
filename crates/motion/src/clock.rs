/// The clock of a curve: how far it has run after a time.
///
/// ```text
/// s' = w(t / fade)            for t < fade,            w(u) = 10 u^3 - 15 u^4 + 6 u^5
/// s' = 1                      between
/// s' = w((T - t) / fade)      for t > T - fade
/// ```
///
/// The curve is followed as it is, only slower at both ends, where velocity and acceleration are
/// zero. A clock never runs faster than time, so a curve that keeps a velocity limit keeps it with
/// a fade as well. After `T` it has run for `T - fade`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Clock {
    duration_s: f64,
    fade_s: f64,
}

impl Clock {
    /// A clock that runs evenly from beginning to end.
    pub(crate) fn steady(duration_s: f64) -> Self {
        Self { duration_s, fade_s: 0.0 }
    }

    /// A clock that starts and stops smoothly; `fade_s` is at most half of `duration_s`.
    pub(crate) fn fading(duration_s: f64, fade_s: f64) -> Self {
        Self { duration_s, fade_s }
    }

    /// From start to stop (s).
    pub(crate) fn duration_s(self) -> f64 {
        self.duration_s
    }

    /// How far the clock has run in the end (s).
    pub(crate) fn run_s(self) -> f64 {
        self.duration_s - self.fade_s
    }

    /// `s`, `s'` and `s''` at a time (s).
    pub(crate) fn at(self, t: f64) -> [f64; 3] {
        let (t, left) = (t.max(0.0), (self.duration_s - t).max(0.0));
        if t < self.fade_s {
            self.rise(t)
        } else if left < self.fade_s {
            let [s, ds, dds] = self.rise(left);
            [self.run_s() - s, ds, -dds]
        } else {
            [t - 0.5 * self.fade_s, 1.0, 0.0]
        }
    }

    /// The time at which the clock has run for `s` (s).
    pub(crate) fn time_of(self, s: f64) -> f64 {
        let (mut low, mut high) = (0.0, self.duration_s);
        // 60 halvings exhaust a double.
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            let early = self.at(middle)[0] < s;
            (low, high) = if early { (middle, high) } else { (low, middle) };
        }
        0.5 * (low + high)
    }

    /// The first part: `fade (5/2 u^4 - 3 u^5 + u^6)` and its derivatives.
    fn rise(self, t: f64) -> [f64; 3] {
        let u = t / self.fade_s;
        [
            self.fade_s * u.powi(4) * (2.5 - 3.0 * u + u * u),
            u.powi(3) * (10.0 - 15.0 * u + 6.0 * u * u),
            30.0 * u * u * (1.0 - u).powi(2) / self.fade_s,
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_fading_clock_starts_and_stops_at_rest_and_runs_evenly_between() {
        let clock = Clock::fading(10.0, 2.0);
        for (t, expected) in [
            (0.0, [0.0, 0.0, 0.0]),
            (2.0, [1.0, 1.0, 0.0]),
            (5.0, [4.0, 1.0, 0.0]),
            (10.0, [8.0, 0.0, 0.0]),
        ] {
            let near = clock.at(t).iter().zip(expected).all(|(s, e)| (s - e).abs() < 1e-15);
            assert!(near, "{:?} at {t}", clock.at(t));
        }
        for t in [0.3, 1.7, 2.0, 8.0, 8.4, 9.9] {
            let h = 1e-5;
            let [before, now, after] = [clock.at(t - h), clock.at(t), clock.at(t + h)];
            for k in 0..2 {
                let slope = (after[k] - before[k]) / (2.0 * h);
                assert!((slope - now[k + 1]).abs() < 1e-8, "derivative {k} at {t}");
            }
            assert!((clock.time_of(now[0]) - t).abs() < 1e-12, "inverse at {t}");
        }
    }
}
