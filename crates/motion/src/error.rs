use std::path::PathBuf;

use logs::LogError;

/// Why a motion cannot be made.
///
/// Every variant has the key of the value at fault, seen from the table that holds the
/// motion: `sinusoids.amplitude_rad.j4_elbow_pitch`, `sequence.2.hold.duration_s`. A part
/// that is no bare TOML key stands in double quotes.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MotionError {
    /// A joint is named that the robot does not have.
    #[error("{key}: joint {joint} is not one of the robot's, which are {}", expected.join(", "))]
    UnknownJoint {
        /// Key of the value.
        key: String,
        /// The joint named.
        joint: String,
        /// The joints of the robot.
        expected: Vec<String>,
    },
    /// A number is out of its range.
    #[error("{key}: found {found}, {expected} was expected")]
    OutOfRange {
        /// Key of the value.
        key: String,
        /// The number.
        found: f64,
        /// What was expected, in words.
        expected: String,
    },
    /// A motion is too long.
    #[error("{key}: the motion takes {found_s:.1} s, at most {most_s} s were expected")]
    TooLong {
        /// Key of the value that it follows from.
        key: String,
        /// Length found (s).
        found_s: f64,
        /// Longest length (s).
        most_s: f64,
    },
    /// A list has the wrong number of entries.
    #[error("{key}: found {found} entries, {expected} expected")]
    WrongLength {
        /// Key of the list.
        key: String,
        /// Entries found.
        found: usize,
        /// What was expected, in words: `7 as in times_s were`.
        expected: String,
    },
    /// The robot lacks a limit, so that the file has to give the value.
    #[error(
        "{key}: nothing was found, but joint {joint} has no {limit} limit to go by, a value was expected"
    )]
    Missing {
        /// Key of the value that is not there.
        key: String,
        /// The joint.
        joint: String,
        /// The limit that the robot does not have.
        limit: LimitedQuantity,
    },
    /// The motion leaves what a joint may do.
    #[error(
        "{key}: joint {joint} reaches a {quantity} of {found:.6} {unit} at {time_s:.3} s, \
        {low} to {high} {unit} was expected (the robot's limits)"
    )]
    LimitExceeded {
        /// Key of the motion.
        key: String,
        /// The joint.
        joint: String,
        /// Of which kind the limit is.
        quantity: LimitedQuantity,
        /// When, since the beginning of the motion with this key (s).
        time_s: f64,
        /// The value at its worst.
        found: f64,
        /// Smallest value allowed.
        low: f64,
        /// Largest value allowed.
        high: f64,
        /// `rad`, `m`, `rad/s` or `m/s`.
        unit: &'static str,
    },
    /// The arm does not reach a point of the figure.
    #[error(
        "{key}: the point at ({:.4}, {:.4}, {:.4}) m in the base frame, {share:.2} of the way \
        around the figure, is missed by {miss_m:.2e} m, a figure within reach was expected",
        point_m[0], point_m[1], point_m[2]
    )]
    Unreachable {
        /// Key of the motion.
        key: String,
        /// The point (m, base frame).
        point_m: [f64; 3],
        /// Where on the figure it lies, 0 to 1.
        share: f64,
        /// Distance that is left (m).
        miss_m: f64,
    },
    /// A file named in the spec cannot be read as coefficients.
    #[error("{key}: {}: {reason}", path.display())]
    File {
        /// Key of the file.
        key: String,
        /// The file.
        path: PathBuf,
        /// What was found and what was expected.
        reason: String,
    },
    /// A log named in the spec cannot be used.
    #[error("{key}: {problem}")]
    Log {
        /// Key of the log.
        key: String,
        /// What is wrong with it.
        problem: Box<LogError>,
    },
    /// A log has gaps, so that there is no motion across them.
    #[error("{key}: the log falls into {found} parts at its gaps, one was expected")]
    Split {
        /// Key of the log.
        key: String,
        /// The parts found.
        found: usize,
    },
}

/// What is limited.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LimitedQuantity {
    /// Position (rad or m).
    Position,
    /// Velocity (rad/s or m/s).
    Velocity,
}

impl std::fmt::Display for LimitedQuantity {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Position => "position",
            Self::Velocity => "velocity",
        })
    }
}

impl MotionError {
    /// Key of the value at fault.
    pub fn key(&self) -> &str {
        match self {
            Self::UnknownJoint { key, .. }
            | Self::OutOfRange { key, .. }
            | Self::TooLong { key, .. }
            | Self::WrongLength { key, .. }
            | Self::Missing { key, .. }
            | Self::LimitExceeded { key, .. }
            | Self::Unreachable { key, .. }
            | Self::File { key, .. }
            | Self::Log { key, .. }
            | Self::Split { key, .. } => key,
        }
    }
}
