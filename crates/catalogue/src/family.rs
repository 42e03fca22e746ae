use serde::Serialize;

/// Where in a robot an effect has its seat: the letters that its code begins with.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Family {
    /// What resists the motion of a joint.
    Friction,
    /// What lies between motor and link.
    Transmission,
    /// What has to be moved and carried.
    Inertia,
    /// From the effort that is asked for to the torque that acts.
    Drive,
    /// What is reported for what is there.
    Sensing,
    /// How the arm is mounted, and what pulls and pushes it from outside.
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
