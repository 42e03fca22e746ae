#[cfg(feature = "rerun")]
use std::path::Path;
use std::path::PathBuf;

/// Why a recording cannot be written or read.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RecordingError {
    /// The file cannot be made.
    #[error("{path}: the recording cannot be written, {reason}")]
    Unwritable {
        /// The file.
        path: PathBuf,
        /// What the system says.
        reason: String,
    },
    /// The file cannot be read, or holds no recording.
    #[error("{path}: no recording can be read, {reason}")]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// What the system or the decoder says.
        reason: String,
    },
    /// The environment turns recordings off.
    #[error(
        "{path}: nothing would be recorded because the environment holds RERUN={value}; \
         unset it or set it to on"
    )]
    TurnedOff {
        /// The file that was asked for.
        path: PathBuf,
        /// The value found.
        value: String,
    },
    /// The program was built without recordings.
    #[error(
        "{path}: this program was built without recordings, its feature `recording` was expected"
    )]
    LeftOut {
        /// The file that was asked for.
        path: PathBuf,
    },
    /// A list has another length than the scene or the other lists ask for.
    #[error("{thing} has {found} {items}, {expected} were expected")]
    WrongLength {
        /// The list, such as `signal tracking error`.
        thing: String,
        /// What it holds.
        items: &'static str,
        /// Its length.
        found: usize,
        /// The length it should have.
        expected: usize,
    },
    /// A time is not a number that can be shown, or not after the one before.
    #[error("row {row} of a block is at {time_s} s, a time after {previous_s} s was expected")]
    TimeNotIncreasing {
        /// The row in its block, from 0.
        row: usize,
        /// Its time (s).
        time_s: f64,
        /// The time before it (s), minus infinity where there is none.
        previous_s: f64,
    },
    /// The time of an event is not finite.
    #[error("the event {text:?} is at {time_s} s, a finite time was expected")]
    EventTime {
        /// What the event says.
        text: String,
        /// Its time (s).
        time_s: f64,
    },
    /// Two arms have the same name.
    #[error("two arms are named {name}, different names were expected")]
    NameTwice {
        /// The name.
        name: String,
    },
    /// The library that writes the file refuses.
    #[error("the recording stopped, {reason}")]
    Refused {
        /// What it says.
        reason: String,
    },
}

#[cfg(feature = "rerun")]
/// An error of the library, of any of its parts.
pub(crate) fn refusal(error: impl std::fmt::Display) -> RecordingError {
    RecordingError::Refused { reason: error.to_string() }
}

#[cfg(feature = "rerun")]
/// An error of the disk.
pub(crate) fn unwritable(path: &Path, reason: String) -> RecordingError {
    RecordingError::Unwritable { path: path.to_owned(), reason }
}
