use crate::thresholds::ERRORS;

/// How much worse a model does than another, over `n` parts of the data that are independent.
///
/// With `d_b` the weighted sum of squares that part `b` loses by the change, `total = sum(d)` and
/// `error = sd(d) sqrt(n)`: the two are told apart where `mean(d) > 2 sd(d) / sqrt(n)`.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Worse {
    pub total: f64,
    pub error: f64,
}

impl Worse {
    /// From what each part leaves with the one model, and with the other.
    pub fn new(parts: impl IntoIterator<Item = (f64, f64)>) -> Self {
        let change: Vec<f64> = parts.into_iter().map(|(own, other)| other - own).collect();
        let n = change.len() as f64;
        let total = change.iter().sum::<f64>();
        let squares = change.iter().map(|d| (d - total / n).powi(2)).sum::<f64>();
        Self { total, error: (n * squares / (n - 1.0).max(1.0)).sqrt() }
    }

    pub fn is_told_apart(self) -> bool {
        self.total > ERRORS * self.error
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Changes 1, 3, 2, 4: mean 2.5, standard deviation sqrt(5 / 3).
    #[test]
    fn oracle_a_change_is_told_apart_by_two_standard_errors_of_its_mean() {
        let worse = Worse::new([(1.0, 2.0), (0.0, 3.0), (5.0, 7.0), (2.0, 6.0)]);
        assert!((worse.total - 10.0).abs() < 1e-12, "{worse:?}");
        assert!((worse.error - 4.0 * (5.0_f64 / 3.0).sqrt() / 2.0).abs() < 1e-12, "{worse:?}");
        assert!(worse.is_told_apart());
        assert!(!Worse::new([(0.0, 1.0), (0.0, -0.5)]).is_told_apart());
    }
}
