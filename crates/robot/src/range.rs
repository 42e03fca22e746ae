use document::KeyPath;

use crate::misfit::Misfit;

/// Numbers that a key may have.
#[derive(Clone, Copy)]
pub(crate) enum Range {
    Finite,
    NotNegative,
    Positive,
    Share,
}

/// Largest magnitude of any number of a description: sums of products of larger ones could overflow.
pub(crate) const LARGEST: f64 = 1e12;

/// A magnitude in SI units that no robot exceeds, and that magnitude in words.
#[derive(Clone, Copy)]
pub(crate) struct Most(pub f64, pub &'static str);

impl Most {
    pub const MASS: Self = Self(1e6, "a mass of up to 1e6 kg");
    pub const LENGTH: Self = Self(1e4, "a length of up to 1e4 m");
    pub const ANGLE: Self = Self(1e6, "an angle of up to 1e6 rad");
    pub const INERTIA: Self = Self(1e10, "an inertia of up to 1e10 kg m²");
    pub const NUMBER: Self = Self(LARGEST, "a number of up to 1e12");
}

impl Range {
    /// What was expected in place of a number outside the range; `None` inside it.
    pub fn expects(self, value: f64) -> Option<&'static str> {
        let (inside, expected) = match self {
            Self::Finite => (true, "a finite number"),
            Self::NotNegative => (value >= 0.0, "a finite number not below 0"),
            Self::Positive => (value > 0.0, "a finite number above 0"),
            Self::Share => ((0.0..=1.0).contains(&value), "a number from 0 to 1"),
        };
        if inside && value.abs() <= LARGEST {
            return None;
        }
        Some(if inside && value.is_finite() { Most::NUMBER.1 } else { expected })
    }
}

/// Refuses a number outside the range. `quantity` is its key below `site`, with dots for nested tables.
pub(crate) fn in_range(
    site: &KeyPath,
    quantity: &str,
    value: f64,
    range: Range,
) -> Result<(), Misfit> {
    let Some(expected) = range.expects(value) else { return Ok(()) };
    let key = quantity.split('.').fold(site.clone(), |path, key| path.key(key));
    Err(Misfit::new(key, format!("{quantity} is {value}, {expected} was expected")))
}
