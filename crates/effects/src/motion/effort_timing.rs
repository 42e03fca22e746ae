use logs::differentiate;
use robot::{Actuator, TorqueSource};

/// Time by which the logged effort of a joint is early or late.
///
/// ```text
/// effort(t) = x(t + delay - skew),  x = torque + lag d(torque)/dt
/// ```
///
/// A command precedes its torque by delay and lag. A measured torque contains both already. The skew belongs to the
/// log.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct EffortTiming {
    /// Time by which the effort is ahead of the motion (s).
    lead_s: f64,
    /// Time constant of the lag (s).
    lag_s: f64,
}

impl EffortTiming {
    /// The timing of a drive.
    pub fn of(drive: &Actuator) -> Self {
        let times = if is_measured(drive) { [0.0; 2] } else { [drive.delay_s, drive.lag_s] };
        let [delay_s, lag_s] = times;
        Self { lead_s: delay_s - drive.effort_skew_s, lag_s }
    }

    /// The torque, sampled every `period_s`, with the timing of the log.
    pub fn with_log_timing(self, mut torque: Vec<f64>, period_s: f64) -> Vec<f64> {
        if self.lag_s > 0.0 {
            let rate = differentiate(&torque, period_s.recip());
            torque.iter_mut().zip(rate).for_each(|(x, r)| *x += self.lag_s * r);
        }
        if self.lead_s.abs() > 0.0 { shift(&torque, self.lead_s / period_s) } else { torque }
    }
}

/// Whether the log has the measured torque, which contains delay and lag already.
pub(crate) fn is_measured(drive: &Actuator) -> bool {
    matches!(drive.torque_source, TorqueSource::Measured | TorqueSource::Current)
}

/// `x` at `steps` samples later, by cubics through the samples with the slopes of
/// [`differentiate`] there; the first and the last sample are held.
pub(crate) fn shift(x: &[f64], steps: f64) -> Vec<f64> {
    let rate = differentiate(x, 1.0);
    let sample = |i: i64| x[i.clamp(0, x.len() as i64 - 1) as usize];
    let slope = |i: i64| usize::try_from(i).ok().and_then(|i| rate.get(i)).map_or(0.0, |r| *r);
    let whole = steps.floor();
    let u = steps - whole;
    let at = |t: i64| {
        let i = t.saturating_add(whole as i64);
        let next = i.saturating_add(1);
        let rise = sample(next) - sample(i);
        let slopes = [slope(i), slope(next)];
        let bend = [3.0 * rise - 2.0 * slopes[0] - slopes[1], slopes[0] + slopes[1] - 2.0 * rise];
        sample(i) + u * (slopes[0] + u * (bend[0] + u * bend[1]))
    };
    (0..x.len() as i64).map(at).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sine(phase: f64) -> Vec<f64> {
        (0..200).map(|t| (0.1 * f64::from(t) + phase).sin()).collect()
    }

    fn assert_close(a: &[f64], b: &[f64], tolerance: f64) {
        let inner = 5..a.len() - 5;
        let largest = inner.map(|t| (a[t] - b[t]).abs()).fold(0.0, f64::max);
        assert!(largest < tolerance, "{largest}");
    }

    #[test]
    fn a_command_is_ahead_of_its_torque_by_the_delay_and_a_skew_takes_it_back() {
        // Ten samples a second, 0.1 rad a sample.
        let drive = Actuator { delay_s: 0.25, ..Actuator::default() };
        assert_close(&EffortTiming::of(&drive).with_log_timing(sine(0.0), 0.1), &sine(0.25), 1e-4);
        let skewed = Actuator { effort_skew_s: 0.3, ..drive.clone() };
        assert_close(
            &EffortTiming::of(&skewed).with_log_timing(sine(0.0), 0.1),
            &sine(-0.05),
            1e-4,
        );
        let measured = Actuator { torque_source: TorqueSource::Measured, ..drive };
        assert_eq!(EffortTiming::of(&measured).with_log_timing(sine(0.0), 0.1), sine(0.0));
    }

    /// A command `u` with `lag d(tau)/dt + tau = u` and `tau = sin(t)` is `sin(t) + lag cos(t)`.
    #[test]
    fn a_command_that_lags_is_the_torque_and_its_rate() {
        let drive = Actuator { lag_s: 0.2, ..Actuator::default() };
        let expected: Vec<f64> = sine(0.0)
            .iter()
            .zip(sine(std::f64::consts::FRAC_PI_2))
            .map(|(s, c)| s + 0.2 * c)
            .collect();
        assert_close(&EffortTiming::of(&drive).with_log_timing(sine(0.0), 0.1), &expected, 2e-6);
    }

    #[test]
    fn a_time_longer_than_the_log_holds_its_ends() {
        let drive = Actuator { delay_s: 1e300, ..Actuator::default() };
        let late = EffortTiming::of(&drive).with_log_timing(sine(0.0), 0.1);
        assert!(late.iter().all(|x| (x - sine(0.0)[199]).abs() < 1e-12));
        assert!(EffortTiming::of(&drive).with_log_timing(vec![], 0.1).is_empty());
    }
}
