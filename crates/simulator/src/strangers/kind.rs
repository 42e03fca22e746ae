use std::fmt;

use robot::Robot;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::strangers::list::for_each_stranger;

/// Makes [`StrangerKind`] of the list of strangers.
macro_rules! kinds {
    ($($(#[$meaning:meta])* $kind:ident $name:ident;)*) => {
        /// An effect of no catalogue, by name.
        #[derive(
            Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize,
            JsonSchema,
        )]
        #[serde(rename_all = "snake_case")]
        pub enum StrangerKind {
            $($(#[$meaning])* $kind,)*
        }

        impl StrangerKind {
            /// Every stranger, in the order in which random draws count them.
            pub const ALL: &'static [Self] = &[$(Self::$kind,)*];

            /// The name used in files.
            pub const fn name(self) -> &'static str {
                match self {
                    $(Self::$kind => stringify!($name),)*
                }
            }
        }
    };
}

for_each_stranger!(kinds);

impl StrangerKind {
    /// Whether an arm can have it at a joint: what comes from a neighbour needs one, what comes
    /// from weight needs gravity, and only a joint that turns has an eccentric encoder.
    pub fn fits(self, robot: &Robot, joint: usize) -> bool {
        match self {
            Self::SpeedCrosstalk | Self::TiltingBearing => robot.joint_count() > 1,
            Self::SoftMount => robot.gravity_in_base().norm() > 0.0,
            Self::EccentricEncoder => {
                robot.links().get(joint).is_some_and(|link| link.joint.kind.is_rotation())
            }
            _ => true,
        }
    }
}

impl fmt::Display for StrangerKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}
