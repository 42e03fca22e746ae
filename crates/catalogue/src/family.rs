use schemars::JsonSchema;
use serde::Serialize;

/// The part of a robot to which an effect belongs. The letters of its code name the family.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Family {
    /// Resistance to the motion of a joint.
    Friction,
    /// Between motor and link.
    Transmission,
    /// Bodies that a drive moves and carries.
    Inertia,
    /// From the commanded effort to the torque that acts.
    Drive,
    /// From true values to reported ones.
    Sensing,
    /// The mounting of the arm, and forces from outside.
    Environment,
}

impl Family {
    /// Every family, in the order in which they are listed to the user.
    pub const ALL: [Self; 6] = [
        Self::Friction,
        Self::Transmission,
        Self::Inertia,
        Self::Drive,
        Self::Sensing,
        Self::Environment,
    ];

    /// The letters that the codes of its effects begin with.
    pub const fn letters(self) -> &'static str {
        match self {
            Self::Friction => "FR",
            Self::Transmission => "TR",
            Self::Inertia => "IN",
            Self::Drive => "DR",
            Self::Sensing => "SE",
            Self::Environment => "EN",
        }
    }

    /// The name, in JSON and in sentences.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Friction => "friction",
            Self::Transmission => "transmission",
            Self::Inertia => "inertia",
            Self::Drive => "drive",
            Self::Sensing => "sensing",
            Self::Environment => "environment",
        }
    }
}
