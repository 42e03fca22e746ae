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
    /// A link or joint has the same child element twice; the first counts.
    Repeated {
        /// The link or joint, such as `joint elbow`.
        element: String,
        /// The child element, such as `origin`.
        child: String,
        /// Line of the one that is left out, from 1.
        line: usize,
    },
    /// A shape of a link cannot be drawn.
    VisualLeftOut {
        /// Name of the link in the URDF, before links are merged.
        link: String,
        /// What is wrong with it.
        reason: String,
    },
    /// Meshes that the URDF names are not there, or too large; pictures do without them.
    MeshesNotFound {
        /// One of them, as the URDF names it.
        first: String,
        /// How many there are.
        count: usize,
    },
}

impl RobotWarning {
    /// The link whose inertia the warning is about.
    pub fn link(&self) -> Option<&str> {
        match self {
            Self::Massless { link } | Self::Inertia { link, .. } => Some(link),
            Self::Repeated { .. } | Self::VisualLeftOut { .. } | Self::MeshesNotFound { .. } => {
                None
            }
        }
    }
}

impl fmt::Display for RobotWarning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Massless { link } => {
                write!(f, "link {link}: it moves but has no <inertial>, its mass is taken as zero")
            }
            Self::Repeated { element, child, line } => {
                write!(f, "{element}: line {line} holds a second <{child}>, the first counts")
            }
            Self::VisualLeftOut { link, reason } => {
                write!(f, "link {link}: a <visual> is left out of pictures, {reason}")
            }
            Self::MeshesNotFound { first, count } => write!(
                f,
                "{count} mesh files are not there or too large, {first} is one: pictures do without"
            ),
            Self::Inertia { link, defect } => write!(f, "link {link}: {defect}"),
        }
    }
}
