use std::path::{Path, PathBuf};

use crate::{Excerpt, allowance::Exceeded, kind::Stranger, of_run};

/// Why a log cannot be used.
///
/// Rows are counted from 1 at the first row of data; a CSV header is not counted.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum LogError {
    /// There is no such file.
    #[error("{}: there is no such file", path.display())]
    Missing {
        /// The file.
        path: PathBuf,
    },
    /// The path is a directory, or another thing that is not a file.
    #[error("{}: this is {found}, the file of a log was expected", path.display())]
    NotAFile {
        /// The path.
        path: PathBuf,
        /// What it is.
        found: &'static str,
    },
    /// The file is of a kind that is not read, by its first bytes.
    #[error("{}: this is {found}; {advice}", path.display())]
    OtherKind {
        /// The file.
        path: PathBuf,
        /// What it is.
        found: &'static str,
        /// What to do about it.
        advice: &'static str,
    },
    /// The file has no bytes.
    #[error("{}: the file is empty, a log was expected", path.display())]
    Empty {
        /// The file.
        path: PathBuf,
    },
    /// The file cannot be opened or read.
    #[error("{}: it cannot be read: {reason}", path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// What the operating system or the decoder said.
        reason: String,
    },
    /// The file says that it is of a kind, but it is not whole.
    #[error("{}: not a whole {kind} file ({reason}); was it cut off while being copied?", path.display())]
    Broken {
        /// The file.
        path: PathBuf,
        /// The kind.
        kind: &'static str,
        /// What the decoder said.
        reason: String,
    },
    /// A packed file holds more than one of its size can be expected to.
    #[error("{}: unpacked it takes more than the {} MB that are allowed of a packed file of this size", path.display(), allowed >> 20)]
    TooLarge {
        /// The file.
        path: PathBuf,
        /// Bytes that are allowed.
        allowed: u64,
    },
    /// A column is not as long as that of time.
    #[error("{}: column {column} has {found} values, {expected} were expected as in {time}", path.display())]
    ColumnLength {
        /// The file.
        path: PathBuf,
        /// The column.
        column: String,
        /// Values found.
        found: u64,
        /// The column of time.
        time: String,
        /// Values of it.
        expected: u64,
    },
    /// A bag has no joint states on a topic.
    #[error("{}: there are no messages sensor_msgs/msg/JointState{}; it has {}",
        path.display(), topic.as_ref().map(|t| format!(" on the topic {t}")).unwrap_or_default(), few(found))]
    NoTopic {
        /// The file.
        path: PathBuf,
        /// The topic that was asked for.
        topic: Option<String>,
        /// The topics of the bag, with type and encoding.
        found: Vec<String>,
    },
    /// A bag has joint states on several topics, none of them the usual one.
    #[error("{}: it has joint states on {} and none on /joint_states; the topic of the robot must be given",
        path.display(), few(found))]
    SeveralTopics {
        /// The file.
        path: PathBuf,
        /// The topics.
        found: Vec<String>,
    },
    /// A dataset has another number of episodes than one, or none of the number that was asked for.
    #[error("{}: {}, it has {}", path.display(), asked_episode(*asked), episodes(found))]
    Episode {
        /// The folder.
        path: PathBuf,
        /// The episode that was asked for.
        asked: Option<u64>,
        /// The episodes that there are.
        found: Vec<u64>,
    },
    /// A message of a bag cannot be read.
    #[error("{}: message {message} of {topic} cannot be read: {reason}", path.display())]
    BadMessage {
        /// The file.
        path: PathBuf,
        /// The topic.
        topic: String,
        /// Number of the message, from 1.
        message: usize,
        /// What is wrong with it.
        reason: String,
    },
    /// A message of a bag holds some of the joints of the robot and not all.
    #[error("{}: message {message} of {topic} holds joints of the robot, but no {column}", path.display())]
    NotInMessage {
        /// The file.
        path: PathBuf,
        /// The topic.
        topic: String,
        /// Number of the message, from 1.
        message: usize,
        /// The column that is missing.
        column: String,
    },
    /// The file cannot be written.
    #[error("{}: it cannot be written: {reason}", path.display())]
    Unwritable {
        /// The file.
        path: PathBuf,
        /// What the operating system or the encoder said.
        reason: String,
    },
    /// Two columns have the same name.
    #[error("{}: two columns are called {column}, names must be unique", path.display())]
    DuplicateColumn {
        /// The file.
        path: PathBuf,
        /// The name.
        column: String,
    },
    /// The columns of a file have no names, and none were given to them.
    #[error("{}: its columns have no names; they are called column_1 to column_{columns}, \
        a column map that says which is which was expected", path.display())]
    NoNames {
        /// The file.
        path: PathBuf,
        /// Number of columns.
        columns: usize,
    },
    /// A column that is needed is not there.
    #[error("{}: there is no column {column}, {purpose}{}", path.display(), hint(nearest.as_deref()))]
    NoColumn {
        /// The file.
        path: PathBuf,
        /// The column that was expected.
        column: String,
        /// What it is needed for.
        purpose: String,
        /// The column with the most similar name.
        nearest: Option<String>,
    },
    /// A joint of the robot is not in the log.
    #[error("{}: joint {joint} of the robot is not in the log, a column {column} was expected; the log has {}{}",
        path.display(), list(found), hint(nearest.as_deref()))]
    JointAbsent {
        /// The file.
        path: PathBuf,
        /// The robot's joint.
        joint: String,
        /// The column that was expected.
        column: Box<str>,
        /// The joints of the log.
        found: Box<[String]>,
        /// The joints of the robot that the log has.
        shared: Box<[String]>,
        /// The joint of the log with the most similar name that the robot does not have.
        nearest: Option<String>,
    },
    /// A row of a CSV file has too few or too many fields.
    #[error("{}: row {row} has {found} fields, {expected} were expected as in the header", path.display())]
    WrongFieldCount {
        /// The file.
        path: PathBuf,
        /// The row.
        row: usize,
        /// Fields found.
        found: usize,
        /// Fields of the header.
        expected: usize,
    },
    /// A field that should be a number is not.
    #[error("{}: row {row}, column {column}: found {found:?}, a number was expected", path.display())]
    NotANumber {
        /// The file.
        path: PathBuf,
        /// The row.
        row: usize,
        /// The column.
        column: String,
        /// The text found.
        found: String,
    },
    /// A value is missing.
    #[error("{}: row {row}, column {column}: the value is missing, a number was expected", path.display())]
    MissingValue {
        /// The file.
        path: PathBuf,
        /// The row.
        row: usize,
        /// The column.
        column: String,
    },
    /// A value is NaN or infinite.
    #[error("{}: row {row}, column {column}: found {found}, a finite number was expected", path.display())]
    NotFinite {
        /// The file.
        path: PathBuf,
        /// The row.
        row: usize,
        /// The column.
        column: String,
        /// `NaN`, `inf` or `-inf`.
        found: String,
    },
    /// A column holds something other than numbers.
    #[error("{}: column {column} holds {found}, numbers were expected", path.display())]
    ColumnType {
        /// The file.
        path: PathBuf,
        /// The column.
        column: String,
        /// The type found.
        found: String,
    },
    /// Time stands still or goes backwards.
    #[error("{}: row {row}, column {column}: time is {} s after {} s, it must increase from row to row", path.display(), short(*found), short(*previous))]
    TimeNotIncreasing {
        /// The file.
        path: PathBuf,
        /// The row.
        row: usize,
        /// The column of time.
        column: String,
        /// Time of the row before (s).
        previous: f64,
        /// Time of the row (s).
        found: f64,
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
    /// There are too few rows in the seconds that were to be read.
    #[error("{}, {excerpt} after its first row: {found} rows of data, at least {expected} were expected", path.display())]
    ExcerptTooShort {
        /// The file.
        path: PathBuf,
        /// What was to be read.
        excerpt: Excerpt,
        /// Rows found.
        found: usize,
        /// Rows needed.
        expected: usize,
    },
    /// A position is in degrees, by all that is known of the joint.
    #[error("{}: column {column}, row {row}: found {found}, but joint {joint} {expectation}; \
        this looks like degrees where radians were expected: convert it, or give the column its unit in a column map", path.display())]
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
    /// Many samples of a column are none that the joint can have.
    #[error("{}: column {column}, row {row}: found {found}, but {expectation}; \
        {count} of {rows} rows are like it, up to {few} would have been left out", path.display())]
    Impossible {
        /// The file.
        path: PathBuf,
        /// The column.
        column: String,
        /// The first such row.
        row: usize,
        /// What it holds.
        found: f64,
        /// Why it cannot be, as the end of `but ...`.
        expectation: String,
        /// Such rows.
        count: usize,
        /// All rows.
        rows: usize,
        /// How many would have been left out.
        few: usize,
    },
    /// Something in a column map is not what was expected.
    #[error("{problem}")]
    Map {
        /// What, and where it stands.
        problem: Box<document::DocumentError>,
    },
    /// A column map names a joint that the robot does not have.
    #[error("{}: [joint.{joint}]: the robot has no such joint, it has {}{}", path.display(), list(expected), hint(nearest.as_deref()))]
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
    /// A column map gives a unit of another quantity.
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
    /// There is nothing to prepare.
    #[error("no run was given, at least one was expected")]
    NoRuns,
    /// Two runs are not of the same robot.
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
    /// A signal does not have one value per sample of time.
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
    pub(crate) fn unreadable(path: &Path, error: &impl ToString) -> Self {
        Self::Unreadable { path: path.to_owned(), reason: error.to_string() }
    }

    pub(crate) fn other_kind(path: &Path, Stranger { found, advice }: Stranger) -> Self {
        Self::OtherKind { path: path.to_owned(), found, advice }
    }

    pub(crate) fn broken(path: &Path, kind: &'static str, error: &dyn std::fmt::Display) -> Self {
        // A message stays one line and one sentence, whatever the file holds and its decoder says.
        let reason = error.to_string().replace(char::is_control, " ").replace(". ", ", ");
        Self::Broken { path: path.to_owned(), kind, reason }
    }

    pub(crate) fn too_large(path: &Path, Exceeded { allowed }: Exceeded) -> Self {
        Self::TooLarge { path: path.to_owned(), allowed }
    }
}

fn hint(nearest: Option<&str>) -> String {
    // A message stays one line, whatever the names in the file hold.
    let plain = |name: &str| name.replace(char::is_control, " ");
    nearest.map(|name| format!("; did you mean {}?", plain(name))).unwrap_or_default()
}

fn asked_episode(asked: Option<u64>) -> String {
    match asked {
        Some(episode) => format!("there is no episode {episode}"),
        None => "a run is one episode of the dataset".to_owned(),
    }
}

/// Episodes in their order, in a few words.
fn episodes(found: &[u64]) -> String {
    match found {
        [] => "none".to_owned(),
        [only] => only.to_string(),
        [first, .., last] => format!("{} from {first} to {last}", found.len()),
    }
}

/// A number in at most some twenty characters.
fn short(value: f64) -> String {
    let is_tiny = value.abs() > 0.0 && value.abs() < 1e-6;
    let is_plain = !is_tiny && value.abs() < 1e15;
    if is_plain { format!("{value}") } else { format!("{value:e}") }
}

/// The first of them.
fn few(names: &[String]) -> String {
    const MOST: usize = 8;
    let more = names.len().saturating_sub(MOST);
    let first = list(&names[..names.len() - more]);
    if more == 0 { first } else { format!("{first} and {more} more") }
}

fn list(names: &[String]) -> String {
    if names.is_empty() { "none".to_owned() } else { names.join(", ") }
}

/// The candidate most similar to a name, `None` when none is similar.
pub(crate) fn nearest<'a>(name: &str, candidates: impl Iterator<Item = &'a str>) -> Option<String> {
    // At least six letters in ten unchanged: `joint_2` finds `joint2`, not `time`.
    const SIMILAR: f64 = 0.6;
    candidates
        .map(|c| (strsim::normalized_damerau_levenshtein(name, c), c))
        .filter(|(similarity, _)| *similarity >= SIMILAR)
        .max_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, c)| c.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_of_a_file_keeps_the_message_on_one_line() {
        assert_eq!(hint(Some("\0ime\n")), "; did you mean  ime ?");
    }
}
