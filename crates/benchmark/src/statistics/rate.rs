use serde::Serialize;

use crate::statistics::share::wilson;

/// The part of the things of one trial for which something holds, each with a weight.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Fraction {
    /// Weight of those for which it holds.
    pub hits: f64,
    /// Weight of all.
    pub of: f64,
    /// How many they are.
    pub items: usize,
}

/// A part of the things of many trials, and what that says of all trials there could be.
///
/// ```text
/// value = R = sum_i hits_i / sum_i of_i
/// V     = m/(m-1) sum_i (hits_i - R of_i)^2 / (sum_i of_i)^2       over the m trials with of_i > 0
/// n     = min(items, R (1 - R) / V);   m where R is 0 or 1 or one trial is all there is
/// ```
///
/// What is in one trial hangs together, so a trial counts as one draw: `V` is the variance of the ratio
/// over trials (Liang & Zeger 1986), and the 95 per cent interval is the score interval (Wilson 1927)
/// for `n` independent things, as many as have that variance (Korn & Graubard 1998).
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Rate {
    /// The part, none of nothing.
    pub value: Option<f64>,
    /// Things that were counted.
    pub items: usize,
    /// Trials with any.
    pub trials: usize,
    /// 95 per cent interval.
    pub interval: Option<[f64; 2]>,
}

impl Fraction {
    /// Whether it holds for each of several things, and their weights.
    pub(crate) fn of(things: impl Iterator<Item = (bool, f64)>) -> Self {
        things.fold(Self::default(), |sum, (holds, weight)| Self {
            hits: sum.hits + if holds { weight } else { 0.0 },
            of: sum.of + weight,
            items: sum.items + 1,
        })
    }

    /// The part, none of nothing.
    pub fn value(&self) -> Option<f64> {
        (self.of > 0.0).then(|| self.hits / self.of)
    }
}

impl Rate {
    /// The rate over trials; those without any weight say nothing.
    pub fn over(trials: impl Iterator<Item = Fraction>) -> Self {
        let trials: Vec<Fraction> = trials.filter(|fraction| fraction.of > 0.0).collect();
        let items = trials.iter().map(|fraction| fraction.items).sum();
        let m = trials.len() as f64;
        let of: f64 = trials.iter().map(|fraction| fraction.of).sum();
        if trials.is_empty() {
            return Self { value: None, items, trials: 0, interval: None };
        }
        let rate = (trials.iter().map(|fraction| fraction.hits).sum::<f64>() / of).clamp(0.0, 1.0);
        let squares = trials.iter().map(|fraction| (fraction.hits - rate * fraction.of).powi(2));
        let variance = m / (m - 1.0) * squares.sum::<f64>() / (of * of);
        let effective = rate * (1.0 - rate) / variance;
        let known = effective.is_finite() && effective > 0.0;
        let n = if known { effective.min(items as f64) } else { m };
        let interval = Some(wilson(rate * n, n));
        Self { value: Some(rate), items, trials: trials.len(), interval }
    }

    /// Value and interval in per cent, such as `95 % 76-99`; `-` of nothing.
    pub fn words(&self) -> String {
        let (Some(value), Some([low, high])) = (self.value, self.interval) else {
            return "-".to_owned();
        };
        format!("{:.0} % {:.0}-{:.0}", 100.0 * value, 100.0 * low, 100.0 * high)
    }
}
