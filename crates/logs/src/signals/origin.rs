//! Where the signals of a joint come from.

/// Where a signal comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Origin {
    /// Its column.
    Measured,
    /// The derivative of the signal below it.
    Derived,
}

/// Where the velocity and the acceleration of a joint come from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Sources {
    pub velocity: Origin,
    pub acceleration: Origin,
}

impl Sources {
    /// Derivatives of the position.
    pub(crate) const POSITION: Self =
        Self { velocity: Origin::Derived, acceleration: Origin::Derived };
}
