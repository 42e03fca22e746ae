use std::fmt;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::log_kind::LogKind;

/// Makes an enum with a name for each variant, used in files and tables.
macro_rules! named {
    ($(#[$meta:meta])* $type:ident { $($(#[$meaning:meta])* $variant:ident = $name:literal,)* }) => {
        $(#[$meta])*
        #[derive(
            Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize, JsonSchema,
        )]
        #[serde(rename_all = "snake_case")]
        pub enum $type { $($(#[$meaning])* $variant,)* }

        impl $type {
            /// All of them.
            pub const ALL: &[Self] = &[$(Self::$variant,)*];

            /// Its name in files and tables.
            pub const fn name(self) -> &'static str {
                match self { $(Self::$variant => $name,)* }
            }
        }

        impl fmt::Display for $type {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.pad(self.name())
            }
        }
    };
}

named! {
    /// Kind of arm.
    ArmClass {
        /// Barrett's seven joints with cable drives, `robots/wam7`.
        Wam = "wam",
        /// Light links on geared position servos with coarse encoders.
        Hobby = "hobby",
        /// A collaborative arm: fine encoders, fast logs, motor current or joint torque sensors.
        Cobot = "cobot",
        /// Heavy links, slow logs, sometimes a counterbalance.
        Industrial = "industrial",
    }
}

named! {
    /// How an arm is moved.
    MotionClass {
        /// One joint after the other, the others at rest.
        JointByJoint = "joint_by_joint",
        /// Sums of sinusoids at all joints.
        Sinusoids = "sinusoids",
        /// From posture to posture with rests between.
        PointToPoint = "point_to_point",
        /// The same few postures in turn, with slow approaches.
        PickAndPlace = "pick_and_place",
        /// Sines of rising frequency, up to 10 Hz.
        Sweep = "sweep",
        /// A path that a hand has taught, slow and uneven, played back.
        LedByHand = "led_by_hand",
        /// Swings of growing amplitude.
        SwingUp = "swing_up",
        /// One task again and again.
        Repeated = "repeated",
    }
}

named! {
    /// What the effort of a log is.
    EffortClass {
        /// What the controller asked for.
        Command = "command",
        /// Torque of the motor, from its current.
        Current = "current",
        /// Torque behind the transmission, from a sensor.
        JointTorque = "joint_torque",
    }
}

named! {
    /// Where the logs of a trial come from.
    Origin {
        /// Simulated.
        Simulated = "simulated",
        /// Recorded, a cause added to them.
        Transplant = "transplant",
        /// Recorded.
        Recorded = "recorded",
        /// Of another engine that moved the same arm along the same motions.
        AnotherEngine = "another_engine",
    }
}

named! {
    /// What robots in use have and the ordinary draws of a trial lack.
    FieldFeature {
        /// A mass of the nominal model is off by a factor of 1.5 to 4.
        WrongMass = "wrong_mass",
        /// A centre of mass of the nominal model is off by centimetres, or in its sign.
        WrongCentre = "wrong_centre",
        /// Inertias of the nominal model are a placeholder.
        PlaceholderInertia = "placeholder_inertia",
        /// Inertias of the nominal model are in g mm2 or g cm2.
        InertiaUnit = "inertia_unit",
        /// The nominal model has a damping of 1 to 10 at every joint.
        DummyDamping = "dummy_damping",
        /// The nominal model has a tool that the arm lacks.
        ToolTakenOff = "tool_taken_off",
        /// The arm has a tool that the nominal model lacks.
        ToolUnknown = "tool_unknown",
        /// Coulomb friction of a tenth to a third of the RMS effort.
        StrongFriction = "strong_friction",
        /// All drives act late by the same time.
        DelayedDrives = "delayed_drives",
        /// The nominal model calls two joints by each other's name.
        JointsExchanged = "joints_exchanged",
        /// Two joints have each other's columns in the logs.
        ColumnsExchanged = "columns_exchanged",
        /// The nominal model has an axis turned round.
        AxisTurned = "axis_turned",
        /// The nominal model stands upright, the arm is tilted.
        MountUnknown = "mount_unknown",
        /// Half of the logs have a payload.
        PayloadChanged = "payload_changed",
    }
}

/// The class of a trial: its arm, motion, sensors and logs.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Corner {
    /// Origin of its logs.
    pub origin: Origin,
    /// Name of the arm: its class, or the recorded robot.
    pub arm: String,
    /// Kind of motion; the first of a mixture.
    pub motion: MotionClass,
    /// Source of its effort.
    pub effort: EffortClass,
    /// Number of joints.
    pub joints: usize,
    /// Largest step of a position reading (rad or m).
    pub encoder_step: f64,
    /// Rate of the log (Hz).
    pub rate_hz: f64,
    /// Logs given to the diagnosis.
    pub logs: usize,
    /// Total length of these logs (s).
    pub length_s: f64,
    /// Whether all logs are of one motion.
    pub repeats: bool,
    /// What it has of robots in use, in the order of the list.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub field: Vec<FieldFeature>,
    /// In what its logs differ from usual ones.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub log_kinds: Vec<LogKind>,
    /// By how much the goals of servos come late (ms); `None` where a controller follows the motion.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub goal_delay_ms: Option<f64>,
}
