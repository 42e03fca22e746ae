use std::path::{Path, PathBuf};

use document::DocumentError;
use logs::LogError;
use motion::MotionError;
use robot::RobotError;
use simulator::SimulatorError;

use crate::corner::{ArmClass, MotionClass};

/// Why a trial cannot be made.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PopulationError {
    /// An arm cannot be simulated.
    #[error(transparent)]
    Simulator(Box<SimulatorError>),
    /// A log cannot be read or written.
    #[error(transparent)]
    Log(#[from] LogError),
    /// A drawn robot cannot be used.
    #[error(transparent)]
    Robot(#[from] RobotError),
    /// A drawn motion cannot be made.
    #[error(transparent)]
    Motion(#[from] MotionError),
    /// A value of a document is impossible.
    #[error(transparent)]
    Document(#[from] DocumentError),
    /// A folder cannot be used.
    #[error("{}: {reason}", path.display())]
    Folder {
        /// The folder.
        path: PathBuf,
        /// The error of the operating system.
        reason: String,
    },
    /// The truth about a trial cannot be read.
    #[error("{}: the sheet of a trial was expected: {reason}", path.display())]
    UnreadableSheet {
        /// Its file.
        path: PathBuf,
        /// What is wrong with it.
        reason: String,
    },
    /// A generated text cannot be serialised.
    #[error("the {what} of a trial cannot be written: {reason}")]
    Unwritable {
        /// What it is.
        what: &'static str,
        /// Why not.
        reason: String,
    },
    /// An arm has left its range.
    #[error("joint {joint}: it came to {found:.3}, a position from {} to {} was expected", range[0], range[1])]
    LeftItsRange {
        /// The joint.
        joint: String,
        /// Position found (rad or m).
        found: f64,
        /// Its range (rad or m).
        range: [f64; 2],
    },
    /// A scenario without runs.
    #[error("a trial has no run, at least one was expected")]
    NoRun,
    /// A list of choices is empty.
    #[error("{key}: nothing to draw from was found, at least one was expected")]
    NothingToDraw {
        /// What is to be drawn.
        key: &'static str,
    },
    /// No draw gave a motion that the arm can follow.
    #[error(
        "arm {arm}, motion {motion}: no draw of {tries} stayed within the arm's torques and a loop's error, one that does was expected"
    )]
    NoBench {
        /// Kind of arm.
        arm: ArmClass,
        /// Kind of motion.
        motion: MotionClass,
        /// How many arms were drawn.
        tries: usize,
    },
    /// A simulated trial was requested from recorded logs.
    #[error(
        "origin simulated: a trial of recorded logs was asked for, origin recorded or transplant was expected"
    )]
    OriginSimulated,
    /// A folder contains no recorded logs.
    #[error("{}: no arm's recorded logs were found, at least one arm's were expected", data.display())]
    NoRecordedLogs {
        /// The folder.
        data: PathBuf,
    },
    /// No joint moves in the logs, so no cause can be added to them.
    #[error("arm {arm}: no joint of its recorded logs moves, one that does was expected")]
    NothingMoves {
        /// Name of the arm.
        arm: String,
    },
}

impl PopulationError {
    /// The error for a folder.
    pub(crate) fn of_folder(folder: &Path) -> impl Fn(std::io::Error) -> Self {
        |error| Self::Folder { path: folder.to_owned(), reason: error.to_string() }
    }
}

impl From<SimulatorError> for PopulationError {
    fn from(error: SimulatorError) -> Self {
        Self::Simulator(Box::new(error))
    }
}
