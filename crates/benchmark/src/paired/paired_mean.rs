use serde::Serialize;
use statrs::distribution::{ContinuousCDF, StudentsT};

use crate::paired::measures::TrialQuantity;

/// The mean of a number over the same trials, for two results.
///
/// ```text
/// d_i = second_i - first_i,   difference = mean of d,   interval = difference -+ t s / sqrt(n)
/// ```
///
/// with `s` the standard deviation of `d` and `t` the 97.5th percentile of Student's distribution with `n - 1`
/// degrees of freedom. Errors and times are compared by their logarithms and reported as factors.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct PairedMean {
    /// The number.
    pub quantity: TrialQuantity,
    /// Number of trials in which both results have it.
    pub trials: usize,
    /// Mean of the first result, geometric for factors.
    pub first: f64,
    /// Mean of the second result, geometric for factors.
    pub second: f64,
    /// Mean difference, or the factor from the first to the second.
    pub difference: f64,
    /// 95 per cent interval of the difference; `None` for a single trial.
    pub interval: Option<[f64; 2]>,
}

impl PairedMean {
    /// From pairs of a first and a second number, or of their logarithms; `None` without pairs.
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
