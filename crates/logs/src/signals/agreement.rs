use std::f64::consts::TAU;

/// Longest lag that is searched (s).
const LONGEST_LAG_S: f64 = 0.05;
/// Largest relative difference in scale of a usable column.
const SCALE_TOLERANCE: f64 = 0.02;
/// Largest phase shift of the motion by the lag of a usable column (rad).
const PHASE_TOLERANCE: f64 = 0.01;

/// Agreement of a measured derivative, such as a velocity column, with the computed derivative of its signal.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Agreement {
    /// Lag of the measured signal (s), positive when it is late: the maximum of the correlation within
    /// 50 ms, interpolated between samples by a parabola.
    pub lag_s: f64,
    /// Standard error of the lag (s). It is large where the motion is too even to show a lag.
    ///
    /// ```text
    /// rms(measured - scale derived) / (scale rms(d/dt derived) sqrt(cutoff duration))
    /// ```
    ///
    /// `d/dt derived` is taken without its part proportional to `derived`. Each period of the cut-off
    /// counts as one independent sample.
    pub lag_std_s: f64,
    /// Factor from the derivative to the measured signal at that lag, by least squares.
    pub scale: f64,
    /// Correlation coefficient at that lag.
    pub correlation: f64,
}

impl Agreement {
    /// Compares two low-passed signals on one uniform clock.
    ///
    /// `cutoff_hz` is the cut-off of their low-pass. Twenty samples per period of it are enough
    /// for the sums. `None` for constant signals, and for signals shorter than four times the
    /// longest lag.
    pub(crate) fn of(
        measured: &[f64],
        derived: &[f64],
        rate_hz: f64,
        cutoff_hz: f64,
    ) -> Option<Self> {
        let reach = (LONGEST_LAG_S * rate_hz).ceil().max(2.0) as usize;
        let stride = ((rate_hz / (20.0 * cutoff_hz)) as usize).max(1);
        let n = measured.len().min(derived.len());
        if n < 4 * reach {
            return None;
        }
        let rows = || (reach..n - reach).step_by(stride);
        let count = rows().count() as f64;
        let at = |lag: usize| {
            // `lag` counts from -reach: row k of the measured is row k - lag + reach.
            let pairs = || rows().map(|k| (measured[k], derived[k + reach - lag]));
            let (sm, sd) = pairs().fold((0.0, 0.0), |s, (m, d)| (s.0 + m, s.1 + d));
            let (mean_m, mean_d) = (sm / count, sd / count);
            let (mut mm, mut dd, mut md) = (0.0, 0.0, 0.0);
            for (m, d) in pairs() {
                let (m, d) = (m - mean_m, d - mean_d);
                (mm, dd, md) = (mm + m * m, dd + d * d, md + m * d);
            }
            (md / (mm * dd).sqrt(), md / dd)
        };
        let all: Vec<(f64, f64)> = (0..=2 * reach).map(at).collect();
        let (best, &(correlation, scale)) =
            all.iter().enumerate().max_by(|a, b| a.1.0.total_cmp(&b.1.0))?;
        if !correlation.is_finite() || !scale.is_finite() {
            return None;
        }
        let between = match (best.checked_sub(1).and_then(|i| all.get(i)), all.get(best + 1)) {
            (Some(before), Some(after)) => vertex(before.0, correlation, after.0),
            _ => 0.0,
        };
        let lag_s = (best as f64 - reach as f64 + between) / rate_hz;
        let lag_std_s = lag_std(measured, derived, rate_hz, reach, best, scale)
            / (cutoff_hz * n as f64 / rate_hz).sqrt();
        Some(Self { lag_s, lag_std_s, scale, correlation })
    }

    /// Whether the measured signal can replace the derivative: its scale is within 2 %,
    /// and its lag, less two standard errors, shifts the phase of the motion by less than
    /// 0.01 rad.
    ///
    /// The motion is assumed to end at `motion_hz`, so the largest lag is
    /// `0.01 / (2 pi motion_hz)`: 1.6 ms for a motion of 1 Hz. A lag that an even motion
    /// cannot show does no harm in that motion.
    pub fn holds(&self, motion_hz: f64) -> bool {
        self.deviation(motion_hz) <= 1.0
    }

    /// How far the signals differ. 1 is the largest difference that [`Agreement::holds`] allows.
    pub(crate) fn deviation(&self, motion_hz: f64) -> f64 {
        let scale = (self.scale - 1.0).abs() / SCALE_TOLERANCE;
        let lag_s = (self.lag_s.abs() - 2.0 * self.lag_std_s).max(0.0);
        scale.max(TAU * motion_hz * lag_s / PHASE_TOLERANCE)
    }
}

/// Standard error of a lag (s), times the root of the number of independent samples.
fn lag_std(m: &[f64], d: &[f64], rate_hz: f64, reach: usize, lag: usize, scale: f64) -> f64 {
    let shift = |k: usize| k + reach - lag;
    let rows = reach + 1..m.len().min(d.len()) - reach - 1;
    let of = |f: &dyn Fn(usize) -> f64| centre(rows.clone().map(f).collect());
    let signal = of(&|k| d[shift(k)]);
    let rest = of(&|k| m[k] - scale * d[shift(k)]);
    let slope = of(&|k| 0.5 * rate_hz * (d[shift(k) + 1] - d[shift(k) - 1]));
    let (ss, sd, dd) = (dot(&slope, &slope), dot(&slope, &signal), dot(&signal, &signal));
    let free = (ss - sd * sd / dd).max(f64::MIN_POSITIVE);
    (dot(&rest, &rest) / free).sqrt() / scale.abs()
}

fn centre(mut x: Vec<f64>) -> Vec<f64> {
    let mean = x.iter().sum::<f64>() / x.len().max(1) as f64;
    x.iter_mut().for_each(|v| *v -= mean);
    x
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

/// Position of the top of the parabola through three neighbouring values, in steps from the middle one.
fn vertex(before: f64, middle: f64, after: f64) -> f64 {
    let curvature = before - 2.0 * middle + after;
    if curvature < 0.0 { (0.5 * (before - after) / curvature).clamp(-0.5, 0.5) } else { 0.0 }
}
