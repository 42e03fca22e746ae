/// Difference of the errors of two models over `n` independent parts of the data.
///
/// `d_b` is the weighted sum of squares of the second model on part `b` minus that of the first, `total = sum(d)` and
/// `error = sd(d) sqrt(n)`. The second model does worse where `mean(d) > errors sd(d) / sqrt(n)`.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PairedDifference {
    pub total: f64,
    pub error: f64,
}

impl PairedDifference {
    /// From the sums of squares of the first and the second model on each part.
    pub fn new(parts: impl IntoIterator<Item = (f64, f64)>) -> Self {
        let change: Vec<f64> = parts.into_iter().map(|(own, other)| other - own).collect();
        let n = change.len() as f64;
        let total = change.iter().sum::<f64>();
        let squares = change.iter().map(|d| (d - total / n).powi(2)).sum::<f64>();
        Self { total, error: (n * squares / (n - 1.0).max(1.0)).sqrt() }
    }

    /// Whether the second model does worse by more than so many standard errors.
    pub fn exceeds(self, errors: f64) -> bool {
        self.total > errors * self.error
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Changes 1, 3, 2, 4: mean 2.5, standard deviation sqrt(5 / 3).
    #[test]
    fn oracle_a_difference_exceeds_two_standard_errors_of_its_mean() {
        let found = PairedDifference::new([(1.0, 2.0), (0.0, 3.0), (5.0, 7.0), (2.0, 6.0)]);
        assert!((found.total - 10.0).abs() < 1e-12, "{found:?}");
        assert!((found.error - 4.0 * (5.0_f64 / 3.0).sqrt() / 2.0).abs() < 1e-12, "{found:?}");
        assert!(found.exceeds(2.0));
        assert!(!PairedDifference::new([(0.0, 1.0), (0.0, -0.5)]).exceeds(2.0));
    }
}
