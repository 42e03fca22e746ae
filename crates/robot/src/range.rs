use crate::RobotError;

/// Numbers that a key may have.
#[derive(Clone, Copy)]
pub(crate) enum Range {
    Finite,
    NotNegative,
    Positive,
    Share,
}

/// Largest size of any number of a description: sums of products of what is larger leave what a computer
/// can count.
pub(crate) const LARGEST: f64 = 1e12;

/// A size in SI units beyond which no robot is, and that size in words.
#[derive(Clone, Copy)]
pub(crate) struct Most(pub f64, pub &'static str);

impl Most {
    pub const MASS: Self = Self(1e6, "a mass of up to 1e6 kg");
    pub const LENGTH: Self = Self(1e4, "a length of up to 1e4 m");
    pub const ANGLE: Self = Self(1e6, "an angle of up to 1e6 rad");
    pub const INERTIA: Self = Self(1e10, "an inertia of up to 1e10 kg m²");
    pub const NUMBER: Self = Self(LARGEST, "a number of up to 1e12");
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
    if inside && value.abs() <= LARGEST {
        return Ok(());
    }
    let expected = if inside && value.is_finite() { Most::NUMBER.1 } else { expected };
    Err(RobotError::OutOfRange { thing: thing.to_owned(), quantity, value, expected })
}
