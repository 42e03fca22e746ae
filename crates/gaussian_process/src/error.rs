/// Input that a Gaussian process can be neither fitted to nor evaluated at.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum GpError {
    /// A slice has the wrong length.
    #[error("{vector} has {got} entries, {expected} were expected")]
    WrongLength {
        /// The slice.
        vector: &'static str,
        /// Entries expected.
        expected: usize,
        /// Entries found.
        got: usize,
    },
    /// An entry is NaN or infinite.
    #[error("{vector}[{index}] is {value}, a finite number was expected")]
    NotFinite {
        /// The slice.
        vector: &'static str,
        /// Index of the entry.
        index: usize,
        /// Its value.
        value: f64,
    },
    /// A hyperparameter that has to be positive is not.
    #[error("{name} is {value}, a positive number was expected")]
    NotPositive {
        /// The hyperparameter.
        name: &'static str,
        /// Its value.
        value: f64,
    },
    /// There are no points.
    #[error("there are no points to learn from")]
    NoPoints,
    /// The covariance matrix stays indefinite with the largest jitter allowed.
    #[error(
        "the covariance of the {points} points is not positive definite even with {jitter:.1e} \
         added to its diagonal: raise the noise variance or leave out points that repeat others"
    )]
    NotPositiveDefinite {
        /// Number of points.
        points: usize,
        /// The largest jitter tried.
        jitter: f64,
    },
}

/// Refuses a slice of another length than `expected` or with an entry that is not finite.
pub(crate) fn check(vector: &'static str, values: &[f64], expected: usize) -> Result<(), GpError> {
    if values.len() != expected {
        return Err(GpError::WrongLength { vector, expected, got: values.len() });
    }
    match values.iter().enumerate().find(|(_, v)| !v.is_finite()) {
        Some((index, &value)) => Err(GpError::NotFinite { vector, index, value }),
        None => Ok(()),
    }
}
