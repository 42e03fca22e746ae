use std::fmt;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Makes the enum, with a name for files and one for sheets for each variant.
macro_rules! log_kinds {
    ($($(#[$meaning:meta])* $variant:ident = $name:literal, $words:literal;)*) => {
        /// In what logs differ from usual ones.
        ///
        /// Each has a size, whose meaning and unit stand beside it; in brackets what it is where none is given.
        #[derive(
            Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize, JsonSchema,
        )]
        #[serde(rename_all = "snake_case")]
        pub enum LogKind { $($(#[$meaning])* $variant,)* }

        impl LogKind {
            /// All of them.
            pub const ALL: &[Self] = &[$(Self::$variant,)*];

            /// Its name in files and tables.
            pub const fn name(self) -> &'static str {
                match self { $(Self::$variant => $name,)* }
            }

            /// Its name among the strangers of a sheet.
            pub const fn stranger(self) -> &'static str {
                match self { $(Self::$variant => $words,)* }
            }
        }
    };
}

log_kinds! {
    /// The effort of a joint has the other sign. Size: the share of rows, the last ones of a log (1).
    EffortSign = "effort_sign", "log: effort sign";
    /// Position and velocity of a joint have the other sign. Size: the share of rows, the last ones (1).
    PositionSign = "position_sign", "log: position sign";
    /// Two joints have each other's effort. Size: the share of rows, the last ones (1).
    EffortsExchanged = "efforts_exchanged", "log: efforts exchanged";
    /// Efforts are in mN m. Size: the share of rows, the last ones (1).
    EffortUnit = "effort_unit", "log: effort in mN m";
    /// Efforts are without the torque of gravity. Size: the share of gravity that is missing (1).
    EffortWithoutGravity = "effort_without_gravity", "log: effort without gravity";
    /// Time is in ms. Size: the share of rows, the last ones (1).
    TimeUnit = "time_unit", "log: time in ms";
    /// All clocks run slower than they should. Size: by this share (0.1).
    TimeStretched = "time_stretched", "log: time stretched";
    /// An encoder stands still in the first log. Size: the share of its rows (from a third to two thirds on).
    StuckEncoder = "stuck_encoder", "log: stuck encoder";
    /// All signals of the first log stand still while time goes on. Size: the share of its rows (1.5 s).
    HeldByLogger = "held_by_logger", "log: held by logger";
    /// Single samples of a position in the first log are off by 0.05. Size: the share of its rows (five rows).
    Spikes = "spikes", "log: spikes";
    /// A position jumps by a turn. Size: the share of rows behind the jump (from a third to two thirds).
    TurnJump = "turn_jump", "log: jump by a turn";
    /// Efforts are zero in some rows of a joint. Size: the share of its rows (0.001 to 0.5).
    EffortZeros = "effort_zeros", "log: zeros in an effort";
    /// Single efforts of a joint are beyond all others. Size: the share of its rows (one to three rows).
    EffortSpikes = "effort_spikes", "log: spikes in an effort";
    /// Efforts of all joints have no sign. Size: the share of rows, the last ones (1).
    EffortWithoutSign = "effort_without_sign", "log: effort without a sign";
    /// Efforts are motor currents, with another constant at every joint. Size: the efforts stay in N m, and are off
    /// by up to this share, at every joint by another one (amperes).
    EffortInAmperes = "effort_in_amperes", "log: effort in amperes";
    /// A joint has more torque than its description allows. Size: by how much of it (0.05 to 0.4).
    BeyondStatedLimit = "beyond_stated_limit", "log: torque beyond the stated limit";
    /// The clock of one of several logs runs slower or faster. Size: slower by this share (-0.2 to 0.2).
    OtherClock = "other_clock", "log: another clock in one run";
    /// Positions and goals are -100 to 100 over the range of a joint; servos alone. Size: none.
    NormalisedUnits = "normalised_units", "log: normalised units";
    /// All signals are repeated in rows between their messages. Size: the share of rows that repeat the one before,
    /// at random (messages of at most 100 Hz in rows of 500 or 1000 Hz).
    HeldValues = "held_values", "log: held values";
    /// The log has few rows. Size: their rate in Hz (20, 30 or 50).
    LowRate = "low_rate", "log: low rate";
    /// No sensor has noise or steps. Size: none.
    NoNoise = "no_noise", "log: no noise";
}

impl LogKind {
    /// What the share [`PopulationSpec::spoilt`](crate::PopulationSpec::spoilt) draws from.
    pub(crate) const SPOILT: [Self; 11] = [
        Self::EffortSign,
        Self::PositionSign,
        Self::EffortsExchanged,
        Self::EffortUnit,
        Self::EffortWithoutGravity,
        Self::TimeUnit,
        Self::TimeStretched,
        Self::StuckEncoder,
        Self::HeldByLogger,
        Self::Spikes,
        Self::TurnJump,
    ];

    /// Whether what is logged is untrue; all else is a true log, with fewer or more rows or less noise than usual.
    pub fn is_spoilt(self) -> bool {
        !matches!(self, Self::HeldValues | Self::LowRate | Self::NoNoise)
    }

    /// Whether logs and described robot say how to undo it or what to leave out, so that a program can find the
    /// causes all the same: a sign that is lost in every row comes back nowhere, all else has a rule or a rest.
    pub fn is_readable(self) -> bool {
        self != Self::EffortWithoutSign
    }

    /// Whether it is in the efforts, which logs of servos do not have.
    pub(crate) fn is_of_effort(self) -> bool {
        matches!(
            self,
            Self::EffortSign
                | Self::EffortsExchanged
                | Self::EffortUnit
                | Self::EffortWithoutGravity
                | Self::EffortZeros
                | Self::EffortSpikes
                | Self::EffortWithoutSign
                | Self::EffortInAmperes
                | Self::BeyondStatedLimit
        )
    }

    /// Least and largest size; `None` where it has no size.
    pub fn sizes(self) -> Option<[f64; 2]> {
        match self {
            Self::NormalisedUnits | Self::NoNoise => None,
            Self::LowRate => Some([5.0, 100.0]),
            Self::OtherClock => Some([-0.5, 1.0]),
            _ => Some([0.0, 1.0]),
        }
    }

    /// Number of joints that it is in; `None` for all.
    pub(crate) fn joints(self) -> Option<usize> {
        match self {
            Self::EffortsExchanged => Some(2),
            Self::EffortSign
            | Self::PositionSign
            | Self::StuckEncoder
            | Self::Spikes
            | Self::TurnJump
            | Self::EffortZeros
            | Self::EffortSpikes
            | Self::BeyondStatedLimit => Some(1),
            _ => None,
        }
    }
}

impl fmt::Display for LogKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}
