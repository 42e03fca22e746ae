use serde::{Deserialize, Serialize};

use crate::statistics::share::wilson;

/// The part of the items of one trial for which something holds, each item with a weight.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Fraction {
    /// Weight of the items for which it holds.
    pub hits: f64,
    /// Weight of all items.
    pub of: f64,
    /// Number of items.
    pub items: usize,
}

/// A rate over the items of many trials, as an estimate for all possible trials:
///
/// ```text
/// value = R = sum_i hits_i / sum_i of_i
/// V     = m/(m-1) sum_i (hits_i - R of_i)^2 / (sum_i of_i)^2       over the m trials with of_i > 0
/// n     = min(items, R (1 - R) / V);   m where R is 0 or 1 or one trial is all there is
/// ```
///
/// Items of one trial are dependent, so that a trial counts as one draw. `V` is the variance of the ratio over trials
/// (Liang & Zeger 1986). The 95 per cent interval is the score interval (Wilson 1927) for `n` independent items,
/// where `n` gives the same variance (Korn & Graubard 1998).
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Rate {
    /// The rate; `None` without items.
    pub value: Option<f64>,
    /// Number of items.
    pub items: usize,
    /// Number of trials with items.
    pub trials: usize,
    /// 95 per cent interval.
    pub interval: Option<[f64; 2]>,
}

impl Fraction {
    /// The fraction of several items, each with whether it holds and its weight.
    pub(crate) fn of(things: impl Iterator<Item = (bool, f64)>) -> Self {
        things.fold(Self::default(), |sum, (holds, weight)| Self {
            hits: sum.hits + if holds { weight } else { 0.0 },
            of: sum.of + weight,
            items: sum.items + 1,
        })
    }

    /// The fraction; `None` without weight.
    pub fn value(&self) -> Option<f64> {
        (self.of > 0.0).then(|| self.hits / self.of)
    }
}

impl Rate {
    /// The rate over trials; trials without weight are left out.
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

    /// Value and interval in per cent, such as `95 % 76-99`; `-` without items.
    pub fn words(&self) -> String {
        let (Some(value), Some([low, high])) = (self.value, self.interval) else {
            return "-".to_owned();
        };
        format!("{:.0} % {:.0}-{:.0}", 100.0 * value, 100.0 * low, 100.0 * high)
    }
}
