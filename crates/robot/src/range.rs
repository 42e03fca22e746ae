use crate::RobotError;

/// Numbers that a key may have.
#[derive(Clone, Copy)]
pub(crate) enum Range {
    Finite,
    NotNegative,
    Positive,
    Share,
}

/// Refuses a number outside the range.
pub(crate) fn in_range(
    thing: &str,
    quantity: &'static str,
    value: f64,
    range: Range,
) -> Result<(), RobotError> {
    let (inside, expected) = match range {
        Range::Finite => (true, "a finite number"),
        Range::NotNegative => (value >= 0.0, "a finite number not below 0"),
        Range::Positive => (value > 0.0, "a finite number above 0"),
        Range::Share => ((0.0..=1.0).contains(&value), "a number from 0 to 1"),
    };
    if inside && value.is_finite() {
        return Ok(());
    }
    Err(RobotError::OutOfRange { thing: thing.to_owned(), quantity, value, expected })
}
