//! The origin of the signals of a joint.

/// Origin of a signal.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Origin {
    /// The column of the signal.
    Measured,
    /// The derivative of the signal one order below.
    Derived,
}

/// Origin of the velocity and the acceleration of a joint.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Sources {
    pub velocity: Origin,
    pub acceleration: Origin,
}

impl Sources {
    /// Velocity and acceleration are derivatives of the position.
    pub(crate) const POSITION: Self =
        Self { velocity: Origin::Derived, acceleration: Origin::Derived };
}
