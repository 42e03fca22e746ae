use std::path::PathBuf;

use next_motion::NextMotionError;

/// Why no motion can be designed.
#[derive(Debug, thiserror::Error)]
pub enum DesignError {
    /// The diagnosis cannot be read.
    #[error("{}: {reason}, the diagnosis.json of a diagnosis was expected", path.display())]
    Diagnosis {
        /// The file.
        path: PathBuf,
        /// What was found.
        reason: String,
    },
    /// A file that was diagnosed is no longer there.
    #[error(
        "{}: {} was made from it and it is not there; {option} names where it is now",
        path.display(),
        diagnosis.display()
    )]
    Gone {
        /// The file.
        path: PathBuf,
        /// The diagnosis.
        diagnosis: PathBuf,
        /// The option that names it.
        option: &'static str,
    },
    /// The diagnosis leaves nothing open.
    #[error(
        "{}: every cause in it stands alone and is determined, there is nothing to tell apart",
        path.display()
    )]
    NothingOpen {
        /// The diagnosis.
        path: PathBuf,
    },
    /// A log that was diagnosed is another one by now.
    #[error("{}: it is not a log that was diagnosed, give those with --log", path.display())]
    OtherLog {
        /// The log.
        path: PathBuf,
    },
    /// A cause acts at no place of this name.
    #[error("{effect} at {found}: {expected} was expected")]
    Place {
        /// The effect.
        effect: String,
        /// The place asked for.
        found: String,
        /// The places where it can act.
        expected: String,
    },
    /// A cause has no columns that a motion could be searched by.
    #[error("{effect}: no motion is searched for it, {reason}")]
    NoModel {
        /// The effect.
        effect: String,
        /// What it would need.
        reason: &'static str,
    },
    /// The motion cannot be searched.
    #[error(transparent)]
    Search(#[from] NextMotionError),
}

impl DesignError {
    /// 2 for usage, 3 for data that cannot be used.
    pub fn exit_code(&self) -> u8 {
        match self {
            Self::Place { .. } | Self::NoModel { .. } => 2,
            Self::Search(NextMotionError::Setting { .. } | NextMotionError::NoGoal) => 2,
            _ => 3,
        }
    }
}
