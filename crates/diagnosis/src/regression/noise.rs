use crate::regression::gram::JointGram;

/// Variance and autocorrelation time of the noise of each stratum.
///
/// Near rest dry friction has any value up to its level, so that a right model leaves there up to a hundred times what it
/// leaves in sliding. With one variance for both, this would hide what the sliding samples show.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Noise {
    /// Variance of the residual ((N·m)² or N²).
    pub variance: Vec<f64>,
    /// Integrated autocorrelation time (samples), at least one.
    pub time: Vec<f64>,
}

impl Noise {
    /// The noise of residuals `[stratum][stretch][sample]`; see [`least_sliding`](crate::thresholds::signals::SignalThresholds::least_sliding).
    pub fn of(residuals: &[Vec<Vec<f64>>], least_share: f64) -> Self {
        let power = |stretches: &Vec<Vec<f64>>| {
            let all = || stretches.iter().flatten();
            (all().map(|r| r * r).sum(), all().count())
        };
        Self {
            variance: variances(residuals.iter().map(power).collect(), least_share),
            time: residuals.iter().map(|s| integrated_time(s)).collect(),
        }
    }

    /// White noise as large as the signals of all strata.
    pub fn of_grams(strata: &[JointGram], least_share: f64) -> Self {
        let powers = strata.iter().map(|gram| (gram.yy, gram.count)).collect();
        Self { variance: variances(powers, least_share), time: vec![1.0; strata.len()] }
    }

    /// Weight of the squared residuals of stratum `s` in the log-likelihood:
    ///
    /// ```text
    /// c_s = 1 / (variance_s time_s)
    /// ```
    ///
    /// so that `n` correlated samples count as `n / time` independent ones. A joint that did not move, or whose
    /// residual is zero, has weight zero.
    pub fn weights(&self, moved: &[bool]) -> Vec<f64> {
        let moved = moved.iter().flat_map(|moved| [moved; 2]);
        let floor = self.variance.iter().fold(0.0, |m: f64, v| m.max(*v)) * 1e-12;
        let weight = |((v, t), moved): ((&f64, &f64), &bool)| {
            if *moved && *v > 0.0 { 1.0 / (v.max(floor) * t) } else { 0.0 }
        };
        self.variance.iter().zip(&self.time).zip(moved).map(weight).collect()
    }
}

/// Variances from the sums of squares and counts of both strata of every joint: at least that of sliding near rest, and
/// that of both where fewer than `least_share` of the samples slide.
fn variances(powers: Vec<(f64, usize)>, least_share: f64) -> Vec<f64> {
    let of_joint = |strata: &[(f64, usize)]| -> [f64; 2] {
        let [sliding, near_rest] = [strata[0], strata[1]];
        let mean = |(sum, count): (f64, usize)| sum / count.max(1) as f64;
        let all = (sliding.0 + near_rest.0, sliding.1 + near_rest.1);
        let is_few = (sliding.1 as f64) < least_share * all.1 as f64;
        if is_few { [mean(all); 2] } else { [mean(sliding), mean(sliding).max(mean(near_rest))] }
    };
    powers.chunks_exact(2).flat_map(of_joint).collect()
}

/// Integrated autocorrelation time (samples) of a signal recorded in stretches:
///
/// ```text
/// time = 1 + 2 sum_{k=1}^{M} rho(k),  M the smallest lag with M >= 5 time
/// ```
///
/// The mean is not subtracted: a residual that stays on one side carries little information.
///
/// # Source
///
/// A. Sokal, *Monte Carlo Methods in Statistical Mechanics*, 1997, section 3.
pub(crate) fn integrated_time(stretches: &[Vec<f64>]) -> f64 {
    let longest = stretches.iter().map(Vec::len).max().unwrap_or(0);
    let covariance = |lag: usize| -> f64 {
        let products = stretches.iter().flat_map(|s| s.iter().zip(s.iter().skip(lag)));
        products.map(|(a, b)| a * b).sum()
    };
    let power = covariance(0);
    if power <= 0.0 {
        return 1.0;
    }
    let mut time: f64 = 1.0;
    for lag in 1..longest {
        time += 2.0 * covariance(lag) / power;
        if lag as f64 >= 5.0 * time {
            break;
        }
    }
    time.max(1.0)
}

#[cfg(test)]
mod tests {
    use rand::{RngExt, SeedableRng};

    use super::*;

    /// A joint whose residual is 3 near rest and 1 while it slides, and one that slides in too few samples.
    #[test]
    fn each_stratum_has_its_own_variance_where_it_has_samples_enough() {
        let residual = |size: f64, samples: usize| vec![vec![size; samples]];
        let of = |sliding, near_rest| Noise::of(&[sliding, near_rest], 0.1).variance;
        assert_eq!(of(residual(1.0, 30), residual(3.0, 10)), [1.0, 9.0]);
        // Near rest the noise is no smaller than elsewhere.
        assert_eq!(of(residual(1.0, 30), residual(0.5, 10)), [1.0, 1.0]);
        assert_eq!(of(residual(1.0, 30), vec![Vec::new()]), [1.0, 1.0]);
        // (1 + 19 9) / 20
        assert_eq!(of(residual(1.0, 1), residual(3.0, 19)), [8.6, 8.6]);
    }

    #[test]
    fn integrated_time_of_a_first_order_process_is_its_closed_form() {
        // x_t = a x_{t-1} + e_t has rho(k) = a^k, time = (1 + a) / (1 - a).
        let (a, n) = (0.8, 200_000);
        let mut rng = rand_chacha::ChaCha8Rng::seed_from_u64(1);
        let mut x = vec![0.0; n];
        for t in 1..n {
            x[t] = a * x[t - 1] + rng.random_range(-1.0..1.0);
        }
        let time = integrated_time(&[x]);
        // Standard deviation of the estimate: 9 sqrt(2 (2 M + 1) / n) with M = 45, 3 %.
        assert!((time / 9.0 - 1.0).abs() < 0.12, "{time}");
    }
}
