/// Why a computation of the dynamics is refused.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum DynamicsError {
    /// A vector or matrix does not have one entry per joint (or per parameter).
    #[error("{vector} has {got} entries, {expected} were expected")]
    WrongLength {
        /// Name of the argument.
        vector: &'static str,
        /// The length expected.
        expected: usize,
        /// The length found.
        got: usize,
    },
    /// A number that must be finite is not.
    #[error("{vector}[{index}] is {value}, a finite number was expected")]
    NotFinite {
        /// Name of the argument.
        vector: &'static str,
        /// Position in the argument.
        index: usize,
        /// The value found.
        value: f64,
    },
    /// The joint-space inertia is not positive definite, so no acceleration follows from a torque.
    #[error(
        "the mass matrix is not positive definite at joint {joint} (pivot {pivot}): \
         check the masses and inertias of the links it carries"
    )]
    MassMatrixNotPositive {
        /// Index of the joint whose pivot failed.
        joint: usize,
        /// The pivot found (kg m² or kg).
        pivot: f64,
    },
    /// A matrix that must be symmetric and positive is not.
    #[error("{matrix} is not positive definite at row {row} (pivot {pivot})")]
    NotPositiveDefinite {
        /// Name of the argument.
        matrix: &'static str,
        /// Row whose pivot failed.
        row: usize,
        /// The pivot found.
        pivot: f64,
    },
    /// A weight that must be positive is not.
    #[error("{name} is {value}, a positive number was expected")]
    NotPositive {
        /// Name of the argument.
        name: &'static str,
        /// The value found.
        value: f64,
    },
    /// A link index is out of range or occurs twice.
    #[error("link index {link} is out of range or repeated, the robot has {count} links")]
    NoSuchLink {
        /// The index found.
        link: usize,
        /// Number of links of the robot.
        count: usize,
    },
}

/// Checks that `values` has `expected` finite entries.
pub(crate) fn check(
    vector: &'static str,
    values: &[f64],
    expected: usize,
) -> Result<(), DynamicsError> {
    if values.len() != expected {
        return Err(DynamicsError::WrongLength { vector, expected, got: values.len() });
    }
    match values.iter().position(|v| !v.is_finite()) {
        Some(index) => Err(DynamicsError::NotFinite { vector, index, value: values[index] }),
        None => Ok(()),
    }
}
