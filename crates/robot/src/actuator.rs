use serde::{Deserialize, Serialize};

/// Where the position of a joint is measured.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum SensingSide {
    /// At the motor, before transmission and elasticity.
    Motor,
    /// At the link, after the transmission.
    Link,
    /// Not stated; where the two sides differ it counts as the motor's.
    #[default]
    Unknown,
}

/// What the `effort` of a log is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum TorqueSource {
    /// A torque sensor at the joint.
    Measured,
    /// The torque that was commanded.
    Commanded,
    /// Motor current times a torque constant.
    Current,
    /// Not stated.
    #[default]
    Unknown,
}

/// What the drive of one joint adds to the rigid-body torque, and how it is measured.
///
/// The effort that the model expects in a log is, with `tau_rb` the rigid-body torque,
///
/// ```text
/// effort = torque_gain (tau_rb + rotor_inertia qdd
///                       + viscous qd + coulomb(qd)
///                       + spring_stiffness (q - spring_rest)) + torque_offset
/// coulomb(qd) = coulomb_forward   for qd > 0
///             = -coulomb_backward for qd < 0, 0 at rest
/// ```
///
/// Between motor and link may lie a transmission that gives way, and between command and
/// torque some time. With `theta` the motor's position seen at the joint,
///
/// ```text
/// |theta - q| <= backlash / 2 + |tau_link| / elasticity,   tau(t) = command(t - delay)
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Actuator {
    /// Inertia of rotor and gear seen at the joint (kg m² or kg).
    pub rotor_inertia: f64,
    /// Viscous friction (N·m·s/rad or N·s/m).
    pub viscous: f64,
    /// Coulomb friction against positive motion (N·m or N).
    pub coulomb_forward: f64,
    /// Coulomb friction against negative motion (N·m or N).
    pub coulomb_backward: f64,
    /// Stiffness of a hose or cable along the joint (N·m/rad or N/m).
    pub spring_stiffness: f64,
    /// Position at which that spring is slack (rad or m).
    pub spring_rest: f64,
    /// Reported effort per unit of true torque.
    pub torque_gain: f64,
    /// Effort reported at zero torque (N·m or N).
    pub torque_offset: f64,
    /// Free play between motor and link, full width (rad or m).
    pub backlash: f64,
    /// Stiffness of the transmission (N·m/rad or N/m); `None` for a rigid one.
    pub elasticity: Option<f64>,
    /// Time from command to torque (s).
    pub delay_s: f64,
    /// Where the position is measured.
    pub sensing: SensingSide,
    /// What the log's effort is.
    pub torque_source: TorqueSource,
}

impl Default for Actuator {
    /// An ideal drive: no friction, no rotor, a rigid transmission, a perfect torque sensor.
    fn default() -> Self {
        Self {
            rotor_inertia: 0.0,
            viscous: 0.0,
            coulomb_forward: 0.0,
            coulomb_backward: 0.0,
            spring_stiffness: 0.0,
            spring_rest: 0.0,
            torque_gain: 1.0,
            torque_offset: 0.0,
            backlash: 0.0,
            elasticity: None,
            delay_s: 0.0,
            sensing: SensingSide::default(),
            torque_source: TorqueSource::default(),
        }
    }
}
