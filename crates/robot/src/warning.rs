use std::fmt;

use crate::structure::inertia::InertiaDefect;
use crate::structure::wide_inertia::WideInertia;

/// A problem in the description of a robot that does not keep it from being used.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum RobotWarning {
    /// A moving link and everything fixed to it have no inertia at all.
    Massless {
        /// Name of the moving link.
        link: String,
    },
    /// The inertia of a moving link and everything fixed to it contradicts physics.
    Inertia {
        /// Name of the moving link.
        link: String,
        /// What is wrong with it.
        defect: InertiaDefect,
    },
    /// An inertia asks for mass far outside of its link: it is in another unit.
    WideInertia(WideInertia),
    /// A joint is held fixed although it mimics a moving joint.
    MimicLocked {
        /// The joint.
        joint: String,
        /// The moving joint that it mimics.
        of: String,
        /// Where it is held (rad or m).
        position: f64,
    },
    /// A joint of a free base is held fixed, since logs do not measure it.
    BaseHeld {
        /// The joint.
        joint: String,
        /// Its type, such as `floating`.
        kind: &'static str,
    },
    /// A base with mass and several limbs is held fixed.
    LimbsOnBase {
        /// The link that is the base.
        link: String,
        /// Number of limbs.
        limbs: usize,
    },
    /// A joint is locked outside its limits.
    LockedOutside {
        /// The joint.
        joint: String,
        /// Where it is locked (rad or m).
        position: f64,
        /// Its limits (rad or m).
        limits: (f64, f64),
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
    /// Elements of an MJCF are ignored.
    NotUnderstood {
        /// What it is, such as `<spatial> of <tendon>`.
        what: String,
        /// How many there are.
        count: usize,
    },
    /// Meshes of the URDF are missing or too large and are left out of pictures.
    MeshesNotFound {
        /// One of them, as the URDF names it.
        first: String,
        /// How many there are.
        count: usize,
    },
}

impl RobotWarning {
    /// Whether the model of the motion may lack something that the robot has. All other warnings
    /// concern numbers, wording and pictures of the file.
    pub fn is_about_motion(&self) -> bool {
        matches!(
            self,
            Self::Massless { .. }
                | Self::WideInertia(_)
                | Self::MimicLocked { .. }
                | Self::BaseHeld { .. }
                | Self::LimbsOnBase { .. }
                | Self::LockedOutside { .. }
                | Self::NotUnderstood { .. }
        )
    }

    /// The link whose inertia the warning is about.
    pub fn link(&self) -> Option<&str> {
        match self {
            Self::Massless { link } | Self::Inertia { link, .. } => Some(link),
            Self::WideInertia(wide) => Some(&wide.link),
            _ => None,
        }
    }
}

impl fmt::Display for RobotWarning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Massless { link } => {
                write!(
                    f,
                    "link {link}: it moves but has no <inertial>, its mass is taken as zero: its \
                     weight and inertia are missing from the torque of every joint that carries it, \
                     and the arm can be simulated only if its joint has a rotor_inertia_kg_m2"
                )
            }
            Self::MimicLocked { joint, of, position } => write!(
                f,
                "joint {joint}: it mimics {of}, which moves, but is held at {position}: what its \
                 motion adds to the torque of {of} is left out"
            ),
            Self::BaseHeld { joint, kind } => write!(
                f,
                "joint {joint}: its type is {kind} and logs do not tell it: the base is held fixed"
            ),
            Self::LimbsOnBase { link, limbs } => write!(
                f,
                "link {link}: it is the base of {limbs} limbs and held fixed: of a robot whose base \
                 moves (it walks, drives or flies) torques are right only while it stands still"
            ),
            Self::LockedOutside { joint, position, limits: (lower, upper) } => write!(
                f,
                "joint {joint}: it is locked at {position}, outside its limits {lower} to {upper}; \
                 locked = {{ {joint} = ... }} in a robot.toml gives another position"
            ),
            Self::Repeated { element, child, line } => {
                write!(f, "{element}: line {line} holds a second <{child}>, the first counts")
            }
            Self::VisualLeftOut { link, reason } => {
                write!(f, "link {link}: a <visual> is left out of pictures, {reason}")
            }
            Self::MeshesNotFound { first, count } => write!(
                f,
                "{count} mesh files are not there or too large, {first} is one: pictures do \
                 without{}",
                if first.starts_with("package://") {
                    "; --package NAME=DIR says where one is"
                } else {
                    ""
                }
            ),
            Self::NotUnderstood { what, count } => write!(
                f,
                "{what} ({count}): it is not read, and what it does to the motion is left out"
            ),
            Self::Inertia { link, defect } => write!(f, "link {link}: {defect}"),
            Self::WideInertia(wide) => write!(f, "{wide}"),
        }
    }
}
