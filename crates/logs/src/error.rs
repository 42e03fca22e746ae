use std::path::{Path, PathBuf};

use log_formats::{Excerpt, FormatError, columns, list, suggestion};

use crate::runs::run::of_run;

/// Why a log cannot be used.
///
/// Rows are counted from 1 at the first row of data; a CSV header is not counted.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum LogError {
    /// The file cannot be read.
    #[error(transparent)]
    File(#[from] FormatError),
    /// The file cannot be written.
    #[error("{}: it cannot be written: {reason}", path.display())]
    Unwritable {
        /// The file.
        path: PathBuf,
        /// What the operating system or the encoder said.
        reason: String,
    },
    /// The columns of a file have no names, and no column map gives them any.
    #[error("{}: its columns have no names; they are called column_1 to column_{columns}, \
        a column map that says which is which was expected", path.display())]
    NoNames {
        /// The file.
        path: PathBuf,
        /// Number of columns.
        columns: usize,
    },
    /// A joint of the robot is not in the log.
    #[error("{}: joint {joint} of the robot is not in the log, a column {column} was expected; the log has {}{}{}",
        path.display(), list(found), columns(other), suggestion(nearest.as_deref()))]
    JointAbsent {
        /// The file.
        path: PathBuf,
        /// The robot's joint.
        joint: Box<str>,
        /// The column that was expected.
        column: Box<str>,
        /// The joints of the log.
        found: Box<[String]>,
        /// The columns of a log without a joint.
        other: Box<[String]>,
        /// The robot's joints that are in the log.
        shared: Box<[String]>,
        /// The joint of the log with the most similar name, among those that are not in the robot.
        nearest: Option<Box<str>>,
    },
    /// A file has vectors of another length than the robot has joints.
    #[error("{}: it has the columns of {found} joints ({pattern}; {words}), and the robot has {} joints: {}",
        path.display(), joints.len(), list(joints))]
    OtherCount {
        /// The file.
        path: PathBuf,
        /// The columns, such as `q[{i}]`.
        pattern: Box<str>,
        /// The preset, in words.
        words: &'static str,
        /// Number of columns.
        found: usize,
        /// The joints of the robot.
        joints: Box<[String]>,
    },
    /// A joint has positions and no effort, which others have.
    #[error("{}: joint {joint} has no effort: {what}{}", path.display(), columns(found))]
    EffortAbsent {
        /// The file.
        path: PathBuf,
        /// The joint.
        joint: String,
        /// What is known of its column.
        what: Box<str>,
        /// The joints that have an effort.
        others: Box<[String]>,
        /// The columns of the file, where the effort has none.
        found: Box<[String]>,
    },
    /// There are too few rows.
    #[error("{}: {found} rows of data, at least {expected} were expected", path.display())]
    TooFewRows {
        /// The file.
        path: PathBuf,
        /// Rows found.
        found: usize,
        /// Rows needed.
        expected: usize,
    },
    /// There are too few rows in the excerpt.
    #[error("{}, {excerpt} after its first row: {found} rows of data, at least {expected} were expected", path.display())]
    ExcerptTooShort {
        /// The file.
        path: PathBuf,
        /// The excerpt.
        excerpt: Excerpt,
        /// Rows found.
        found: usize,
        /// Rows needed.
        expected: usize,
    },
    /// A position must be in degrees, judged by the limits and the speed of the joint.
    #[error("{}: column {column}, row {row}: found {found}, but joint {joint} {expectation}; \
        this looks like degrees{} where radians were expected: convert it, or give the column its unit in a column map", path.display(), or_normalised(path, *found))]
    LooksLikeDegrees {
        /// The file.
        path: PathBuf,
        /// The column.
        column: String,
        /// The row of the value farthest from zero.
        row: usize,
        /// That value.
        found: f64,
        /// The joint.
        joint: String,
        /// What was expected, as the end of `joint j1 ...`.
        expectation: String,
    },
    /// Many samples of a column are impossible for the joint.
    #[error("{}: column {column}, row {row}: found {found}, but {expectation}; \
        {count} of {rows} rows are like it, up to {few} would have been left out", path.display())]
    Impossible {
        /// The file.
        path: PathBuf,
        /// The column.
        column: String,
        /// The first row with an impossible sample.
        row: usize,
        /// The value there.
        found: f64,
        /// Why it is impossible, as the end of `but ...`.
        expectation: String,
        /// Number of rows with an impossible sample.
        count: usize,
        /// Number of all rows.
        rows: usize,
        /// Largest number of rows that are left out.
        few: usize,
    },
    /// A column map has an error.
    #[error("{problem}")]
    Map {
        /// The error, and its place in the file.
        problem: Box<document::DocumentError>,
    },
    /// A column map names a joint that the robot does not have.
    #[error("{}: [joint.{joint}]: the robot has no such joint, it has {}{}", path.display(), list(expected), suggestion(nearest.as_deref()))]
    MapUnknownJoint {
        /// The map file.
        path: PathBuf,
        /// The joint named.
        joint: String,
        /// The joints of the robot.
        expected: Vec<String>,
        /// The joint of the robot with the most similar name.
        nearest: Option<String>,
    },
    /// A column map gives a unit of a wrong quantity.
    #[error("{}: {key}: found the unit {found:?}, a unit of {expected} was expected", path.display())]
    MapWrongUnit {
        /// The map file.
        path: PathBuf,
        /// The key, such as `joint.j1.position`.
        key: String,
        /// The unit found.
        found: String,
        /// The quantity expected.
        expected: &'static str,
    },
    /// A filter of this order cannot be made.
    #[error("the filter's order is {found}, a number from 1 to {highest} was expected")]
    FilterOrder {
        /// Order found.
        found: usize,
        /// Highest order possible.
        highest: usize,
    },
    /// A cut-off cannot be used at this sampling rate.
    #[error(
        "the cut-off is {found_hz} Hz, a frequency above 0 and below {nyquist_hz} Hz (half the sampling rate) was expected"
    )]
    CutoffOutOfRange {
        /// Cut-off found (Hz).
        found_hz: f64,
        /// Half the sampling rate (Hz).
        nyquist_hz: f64,
    },
    /// No runs were given.
    #[error("no run was given, at least one was expected")]
    NoRuns,
    /// Two runs do not have the same joints.
    #[error(
        "{of_run}: its joints are {}, but those of {of_first} are {}",
        list(found),
        list(expected), of_run = of_run(run), of_first = of_run(first))]
    JointsDiffer {
        /// The run.
        run: String,
        /// Its joints.
        found: Vec<String>,
        /// The first run.
        first: String,
        /// The joints of the first run.
        expected: Vec<String>,
    },
    /// A signal has another number of samples than time.
    #[error("{of_run}: {column} has {found} samples, {expected} were expected as in time", of_run = of_run(run))]
    WrongLength {
        /// The run.
        run: String,
        /// The column.
        column: String,
        /// Samples found.
        found: usize,
        /// Samples of time.
        expected: usize,
    },
    /// Two runs whose times cannot both be in seconds.
    #[error("{of_run}: its rows are {step_s:.3e} s apart, those of {of_other} {other_step_s:.3e} s; {}",
        unit_of_time(*unit), of_run = of_run(run), of_other = of_run(other))]
    OtherClock {
        /// The run.
        run: String,
        /// Usual time between its rows (s).
        step_s: f64,
        /// The run whose rows are furthest from that.
        other: String,
        /// Usual time between the rows of the other (s).
        other_step_s: f64,
        /// The unit that its time looks like.
        unit: Option<&'static str>,
    },
    /// A run is too short for the filter.
    #[error(
        "{of_run}: its longest piece without a gap is {found_s:.3} s, at least {expected_s:.3} s were expected \
        (4.5 periods of the {cutoff_hz:.2} Hz cut-off)", of_run = of_run(run))]
    RunTooShort {
        /// The run.
        run: String,
        /// Length of the longest piece (s).
        found_s: f64,
        /// Length needed (s).
        expected_s: f64,
        /// The cut-off (Hz).
        cutoff_hz: f64,
    },
}

impl LogError {
    /// Whether the positions that look like degrees may be normalised instead, -100 to 100 over the range of a calibration.
    pub fn may_be_normalised(&self) -> bool {
        matches!(self, Self::LooksLikeDegrees { path, found, .. } if !or_normalised(path, *found).is_empty())
    }
}

/// What time looks like where its rows are too far apart.
fn unit_of_time(unit: Option<&'static str>) -> String {
    let looks = |unit| format!("its time looks like {unit}, seconds were expected");
    unit.map_or_else(|| "times of both in seconds were expected".to_owned(), looks)
}

/// What a position `found` in a file may be besides degrees. A dataset of `LeRobot` is a folder.
fn or_normalised(path: &Path, found: f64) -> &'static str {
    if path.is_dir() && found.abs() <= 100.0 {
        " or positions normalised to -100 .. 100"
    } else {
        ""
    }
}
