/// Variance and autocorrelation time of the noise of each joint.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Noise {
    /// Variance of the residual ((N·m)² or N²).
    pub variance: Vec<f64>,
    /// Integrated autocorrelation time (samples), at least one.
    pub time: Vec<f64>,
}

impl Noise {
    /// The noise of residuals `[joint][stretch][sample]`.
    pub fn of(residuals: &[Vec<Vec<f64>>]) -> Self {
        let power = |stretches: &Vec<Vec<f64>>| {
            let (n, sum) =
                stretches.iter().flatten().fold((0, 0.0), |(n, s), r| (n + 1, s + r * r));
            sum / f64::from(n.max(1))
        };
        Self {
            variance: residuals.iter().map(power).collect(),
            time: residuals.iter().map(|s| integrated_time(s)).collect(),
        }
    }

    /// Weight of joint `j`'s squared residuals in the log-likelihood:
    ///
    /// ```text
    /// c_j = 1 / (variance_j time_j)
    /// ```
    ///
    /// so that `n` correlated samples count as `n / time` independent ones. A joint that did not move, or whose
    /// residual is zero, has weight zero.
    pub fn weights(&self, moved: &[bool]) -> Vec<f64> {
        let floor = self.variance.iter().fold(0.0, |m: f64, v| m.max(*v)) * 1e-12;
        let weight = |((v, t), moved): ((&f64, &f64), &bool)| {
            if *moved && *v > 0.0 { 1.0 / (v.max(floor) * t) } else { 0.0 }
        };
        self.variance.iter().zip(&self.time).zip(moved).map(weight).collect()
    }
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
