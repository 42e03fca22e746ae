/// A column at one joint: the change of its effort per unit of one weight, along the motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Shape {
    /// `qd`
    Velocity,
    /// `s = tanh(qd / sign_speed)`
    Sign,
    /// `1`
    One,
    /// `qdd`
    Acceleration,
    /// Regressor of an inertial parameter of a link.
    Body {
        /// Index of the link.
        link: usize,
        /// Which of the ten parameters.
        parameter: usize,
    },
}
