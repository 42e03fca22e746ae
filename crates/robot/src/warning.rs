use std::fmt;

use crate::InertiaDefect;

/// Something about a robot that is allowed, but that its owner should know.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum RobotWarning {
    /// A moving link and everything fixed to it have no inertia at all.
    Massless {
        /// Name of the moving link.
        link: String,
    },
    /// An inertia contradicts physics.
    Inertia {
        /// Name of the link in the URDF, before links are merged, or in `robot.toml`.
        link: String,
        /// What is wrong with it.
        defect: InertiaDefect,
    },
}

impl RobotWarning {
    /// The link that the warning is about.
    pub fn link(&self) -> &str {
        match self {
            Self::Massless { link } | Self::Inertia { link, .. } => link,
        }
    }
}

impl fmt::Display for RobotWarning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Massless { link } => {
                write!(f, "link {link}: it moves but has no <inertial>, its mass is taken as zero")
            }
            Self::Inertia { link, defect } => write!(f, "link {link}: {defect}"),
        }
    }
}
