/// Why a motion cannot be tracked.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum TrackingError {
    /// Two parts of a run are made for different numbers of joints.
    #[error("{what} is for {got} joints, {expected} were expected")]
    JointCount {
        /// The part that differs from the others.
        what: &'static str,
        /// Joints that it is for.
        got: usize,
        /// Joints of the machine.
        expected: usize,
    },
    /// A number is out of its range.
    #[error("{quantity} is {found}, {expected} was expected")]
    OutOfRange {
        /// The quantity, with its joint and unit.
        quantity: String,
        /// Its value.
        found: f64,
        /// What was expected, in words.
        expected: &'static str,
    },
    /// Two joints that cannot share two motors.
    #[error("joints {first} and {second} cannot be a differential pair: {because}")]
    Pair {
        /// Index of the first joint.
        first: usize,
        /// Index of the second joint.
        second: usize,
        /// What is wrong with them.
        because: &'static str,
    },
}

/// Refuses a part that is not for `expected` joints.
pub(crate) fn same_joints(
    what: &'static str,
    got: usize,
    expected: usize,
) -> Result<(), TrackingError> {
    if got == expected { Ok(()) } else { Err(TrackingError::JointCount { what, got, expected }) }
}

/// Refuses a number that is not finite or below zero.
pub(crate) fn not_negative(
    quantity: impl FnOnce() -> String,
    found: f64,
) -> Result<(), TrackingError> {
    if found.is_finite() && found >= 0.0 {
        return Ok(());
    }
    let expected = "a finite number of at least 0";
    Err(TrackingError::OutOfRange { quantity: quantity(), found, expected })
}

/// Refuses a number that is not finite or not above zero.
pub(crate) fn positive(quantity: &str, found: f64) -> Result<(), TrackingError> {
    if found.is_finite() && found > 0.0 {
        return Ok(());
    }
    let expected = "a finite number above 0";
    Err(TrackingError::OutOfRange { quantity: quantity.to_owned(), found, expected })
}

/// Refuses a period that no control loop can have (s).
pub(crate) fn period(found: f64) -> Result<(), TrackingError> {
    if found > 0.0 && found <= LONGEST_PERIOD_S {
        return Ok(());
    }
    let (quantity, expected) = ("the period of the machine (s)", "a number above 0, at most 60");
    Err(TrackingError::OutOfRange { quantity: quantity.to_owned(), found, expected })
}

/// Longest period of a control loop (s).
const LONGEST_PERIOD_S: f64 = 60.0;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_period_is_a_time_in_which_an_arm_can_be_controlled() {
        assert_eq!(period(0.002), Ok(()));
        for found in [0.0, -0.002, f64::NAN, f64::INFINITY, 1e30] {
            let words = period(found).unwrap_err().to_string();
            assert!(words.contains("period of the machine (s) is"), "{words}");
        }
    }
}
