use serde::Serialize;
use statrs::distribution::{Beta, Binomial, ContinuousCDF, DiscreteCDF};

use crate::paired::measures::Measure;

/// The same trials asked the same with two answers each.
///
/// ```text
/// wins    trials in which the second answer alone is the better one,  losses  the first alone
/// p       = min(1, 2 P(X <= min(wins, losses))),  X ~ Binomial(wins + losses, 1/2)
/// [a, b]  = Clopper-Pearson interval of wins / (wins + losses)
/// interval = (2 [a, b] - 1) (wins + losses) / trials
/// ```
///
/// The test is McNemar's (1947), exact and given how many trials differ, and so is the interval
/// (Clopper & Pearson 1934).
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct PairedShare {
    /// What is asked.
    pub measure: Measure,
    /// Trials that have both answers.
    pub trials: usize,
    /// Those in which the first answer is yes.
    pub first: usize,
    /// Those in which the second is.
    pub second: usize,
    /// Those in which the second alone is the better one.
    pub wins: usize,
    /// Those in which the first alone is.
    pub losses: usize,
    /// `(wins - losses) / trials`, none without trials.
    pub difference: Option<f64>,
    /// 95 per cent interval of the difference, none where no trial differs.
    pub interval: Option<[f64; 2]>,
    /// How likely at most so few wins or losses are, if either is as likely.
    pub p: f64,
}

impl PairedShare {
    /// Pairs of a first and a second answer.
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

/// None where there are neither.
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
