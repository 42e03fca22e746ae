use serde::Serialize;
use statrs::distribution::{ContinuousCDF, StudentsT};

use crate::paired::measures::TrialQuantity;

/// The mean of a number over the same trials, with two answers each.
///
/// ```text
/// d_i = second_i - first_i,   difference = mean of d,   interval = difference -+ t s / sqrt(n)
/// ```
///
/// with `s` the standard deviation of `d` and `t` the 97.5th percentile of Student's distribution with
/// `n - 1` degrees of freedom. Of errors and times the logarithms are taken, and all is on_scale as factors.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct PairedMean {
    /// Which number.
    pub quantity: TrialQuantity,
    /// Trials that have both.
    pub trials: usize,
    /// Mean of the first, geometric for factors.
    pub first: f64,
    /// Mean of the second.
    pub second: f64,
    /// Mean difference, or the factor from the first to the second.
    pub difference: f64,
    /// 95 per cent interval of it, none of a single trial.
    pub interval: Option<[f64; 2]>,
}

impl PairedMean {
    /// Pairs of a first and a second number, or of their logarithms; none without any.
    pub fn new(quantity: TrialQuantity, pairs: &[(f64, f64)]) -> Option<Self> {
        let n = pairs.len() as f64;
        let mean = |of: &dyn Fn(&(f64, f64)) -> f64| pairs.iter().map(of).sum::<f64>() / n;
        let difference = mean(&|pair| pair.1 - pair.0);
        let squares: f64 = pairs.iter().map(|pair| (pair.1 - pair.0 - difference).powi(2)).sum();
        let t = StudentsT::new(0.0, 1.0, n - 1.0).ok().map(|t| t.inverse_cdf(0.975));
        let half = t.map(|t| t * (squares / (n - 1.0) / n).sqrt());
        let on_scale = |number: f64| if quantity.is_factor() { number.exp() } else { number };
        (!pairs.is_empty()).then(|| Self {
            quantity,
            trials: pairs.len(),
            first: on_scale(mean(&|pair| pair.0)),
            second: on_scale(mean(&|pair| pair.1)),
            difference: on_scale(difference),
            interval: half.map(|half| [difference - half, difference + half].map(on_scale)),
        })
    }
}
