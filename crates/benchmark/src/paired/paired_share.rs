use serde::Serialize;
use statrs::distribution::{Beta, Binomial, ContinuousCDF, DiscreteCDF};

use crate::paired::measures::Measure;

/// One yes-or-no measure on the same trials, for two results.
///
/// ```text
/// wins    trials in which the second answer alone is the better one,  losses  the first alone
/// p       = min(1, 2 P(X <= min(wins, losses))),  X ~ Binomial(wins + losses, 1/2)
/// [a, b]  = Clopper-Pearson interval of wins / (wins + losses)
/// interval = (2 [a, b] - 1) (wins + losses) / trials
/// ```
///
/// The test is McNemar's (1947). Test and interval (Clopper & Pearson 1934) are exact, given the number of trials
/// that differ.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct PairedShare {
    /// The measure.
    pub measure: Measure,
    /// Number of trials with both answers.
    pub trials: usize,
    /// Number of trials with yes as the first answer.
    pub first: usize,
    /// Number of trials with yes as the second answer.
    pub second: usize,
    /// Number of trials in which only the second answer is the better one.
    pub wins: usize,
    /// Number of trials in which only the first answer is the better one.
    pub losses: usize,
    /// `(wins - losses) / trials`; `None` without trials.
    pub difference: Option<f64>,
    /// 95 per cent interval of the difference; `None` where no trial differs.
    pub interval: Option<[f64; 2]>,
    /// p-value: probability of a split at least as uneven, if wins and losses are equally likely.
    pub p: f64,
}

impl PairedShare {
    /// From pairs of a first and a second answer.
    pub fn new(measure: Measure, pairs: &[(bool, bool)]) -> Self {
        let count = |is: &dyn Fn(bool, bool) -> bool| pairs.iter().filter(|p| is(p.0, p.1)).count();
        let wanted = measure.is_yes_better();
        let wins = count(&|first, second| first != second && second == wanted);
        let losses = count(&|first, second| first != second && first == wanted);
        let (trials, differing) = (pairs.len(), (wins + losses) as f64);
        let scale = differing / trials.max(1) as f64;
        let interval = clopper_pearson(wins, losses);
        Self {
            measure,
            trials,
            first: count(&|first, _| first),
            second: count(&|_, second| second),
            wins,
            losses,
            difference: (trials > 0).then(|| (wins as f64 - losses as f64) / trials as f64),
            interval: interval.map(|ends| ends.map(|end| (2.0 * end - 1.0) * scale)),
            p: two_sided_p_value(wins, losses),
        }
    }

    /// Trials in which neither answer is the better one.
    pub fn ties(&self) -> usize {
        self.trials - self.wins - self.losses
    }
}

/// `None` where there are neither wins nor losses.
fn clopper_pearson(wins: usize, losses: usize) -> Option<[f64; 2]> {
    if wins + losses == 0 {
        return None;
    }
    let quantile = |a: usize, b: usize, p: f64| {
        Beta::new(a as f64, b as f64).ok().map(|beta| beta.inverse_cdf(p))
    };
    let low = if wins == 0 { Some(0.0) } else { quantile(wins, losses + 1, 0.025) };
    let high = if losses == 0 { Some(1.0) } else { quantile(wins + 1, losses, 0.975) };
    Some([low?, high?])
}

fn two_sided_p_value(wins: usize, losses: usize) -> f64 {
    let fewer = wins.min(losses) as u64;
    let half = Binomial::new(0.5, (wins + losses) as u64).map(|all| all.cdf(fewer));
    half.map_or(1.0, |half| (2.0 * half).min(1.0))
}
