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
    /// Effort of the nominal robot.
    Nominal,
    /// Time derivative of the nominal effort.
    NominalRate,
    /// `q`
    Position,
    /// `|nominal| s`
    LoadSign,
    /// `sin(k phase) s`
    SineSign(u8),
    /// `cos(k phase) s`
    CosineSign(u8),
    /// `sin(k phase)`
    Sine(u8),
    /// `cos(k phase)`
    Cosine(u8),
    /// Torque of a gravity vector of the same length, orthogonal to gravity, in one of two directions.
    Tilt(u8),
    /// Regressor of an inertial parameter of a link.
    Body {
        /// Index of the link.
        link: usize,
        /// Which of the ten parameters.
        parameter: usize,
    },
    /// Change of the effort for a spring of compliance one in the transmission of a joint.
    Spring {
        /// Index of that joint.
        joint: usize,
    },
}
