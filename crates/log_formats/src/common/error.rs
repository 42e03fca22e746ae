use std::path::{Path, PathBuf};

use crate::common::{
    allowance::Exceeded,
    unread_kinds::UnreadKind,
    words::{columns, list, quote, suggestion},
};

/// Why a file cannot be read.
///
/// Rows are counted from 1 at the first row of data; a CSV header is not counted.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FormatError {
    /// There is no such file.
    #[error("{}: there is no such file", path.display())]
    Missing {
        /// The file.
        path: PathBuf,
    },
    /// The path is a directory, or something else that is not a file.
    #[error("{}: this is {found}, the file of a log was expected", path.display())]
    NotAFile {
        /// The path.
        path: PathBuf,
        /// What the path is.
        found: &'static str,
    },
    /// The table has more columns than are read.
    #[error("{}: it has more than {most} columns, at most {most} were expected", path.display())]
    TooManyColumns {
        /// The file.
        path: PathBuf,
        /// Most columns that are read.
        most: usize,
    },
    /// The table has more rows than are read of so many columns.
    #[error("{}: it has more than {most} rows of {columns} columns, at most {most} were expected", path.display())]
    TooManyRows {
        /// The file.
        path: PathBuf,
        /// Columns of the table.
        columns: usize,
        /// Most rows that are read.
        most: u64,
    },
    /// The first bytes of the file show a kind that is not supported.
    #[error("{}: this is {found}; {advice}", path.display())]
    OtherKind {
        /// The file.
        path: PathBuf,
        /// What the file is.
        found: &'static str,
        /// What to do with such a file.
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
    /// The file begins like one of a kind but is incomplete.
    #[error("{}: not a whole {kind} file ({reason}); was it cut off while being copied?", path.display())]
    Broken {
        /// The file.
        path: PathBuf,
        /// The kind.
        kind: &'static str,
        /// What the decoder said.
        reason: String,
    },
    /// A packed file unpacks to more bytes than are allowed for its size.
    #[error("{}: unpacked it takes more than the {} MB that are allowed of a packed file of this size", path.display(), allowed >> 20)]
    TooLarge {
        /// The file.
        path: PathBuf,
        /// Bytes that are allowed.
        allowed: u64,
    },
    /// A column does not have the length of the column of time.
    #[error("{}: column {column} has {found} values, {expected} were expected as in {time}", path.display(), column = quote(column))]
    ColumnLength {
        /// The file.
        path: PathBuf,
        /// The column.
        column: String,
        /// Number of values in the column.
        found: u64,
        /// The column of time.
        time: String,
        /// Number of values in the column of time.
        expected: u64,
    },
    /// A column that several files of a run have is not the same in all.
    #[error("{}: column {column} has other values than in the files before it, the same were expected", path.display(), column = quote(column))]
    OtherColumn {
        /// The file.
        path: PathBuf,
        /// The column.
        column: String,
    },
    /// A bag has no joint states on a topic.
    #[error("{}: there are no joint states{}; it has {}",
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
    /// The episode is not in the dataset, or no episode was asked for and the dataset does not have exactly one.
    #[error("{}: {}, it has {}", path.display(), asked_episode(*asked), episodes(found))]
    Episode {
        /// The folder.
        path: PathBuf,
        /// The episode that was asked for, if any.
        asked: Option<u64>,
        /// The episodes of the dataset.
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
    /// A message of a bag holds only some of the robot's joints.
    #[error("{}: message {message} of {topic} holds joints of the robot, but no {column}", path.display(), column = quote(column))]
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
    /// Two columns have the same name.
    #[error("{}: two columns are called {column}, names must be unique", path.display(), column = quote(column))]
    DuplicateColumn {
        /// The file.
        path: PathBuf,
        /// The name.
        column: String,
    },
    /// A needed column is missing.
    #[error("{}: there is no column {column}, {purpose}{}{}", path.display(), columns(found), suggestion(nearest.as_deref()), column = quote(column))]
    NoColumn {
        /// The file.
        path: PathBuf,
        /// The column that was expected.
        column: String,
        /// What it is needed for.
        purpose: String,
        /// The column with the most similar name.
        nearest: Option<String>,
        /// The columns of the file.
        found: Box<[String]>,
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
    /// A field is not a number.
    #[error("{}: row {row}, column {column}: found {found:?}, a number was expected", path.display(), column = quote(column))]
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
    #[error("{}: row {row}, column {column}: the value is missing, a number was expected", path.display(), column = quote(column))]
    MissingValue {
        /// The file.
        path: PathBuf,
        /// The row.
        row: usize,
        /// The column.
        column: String,
    },
    /// A value is NaN or infinite.
    #[error("{}: row {row}, column {column}: found {found}, a finite number was expected", path.display(), column = quote(column))]
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
    #[error("{}: column {column} holds {found}, numbers were expected", path.display(), column = quote(column))]
    ColumnType {
        /// The file.
        path: PathBuf,
        /// The column.
        column: String,
        /// The type found.
        found: String,
    },
    /// Time does not increase from one row to the next.
    #[error("{}: row {row}, column {column}: time is {} s after {} s, it must increase from row to row", path.display(), short(*found), short(*previous), column = quote(column))]
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
}

impl FormatError {
    pub(crate) fn unreadable(path: &Path, error: &impl ToString) -> Self {
        Self::Unreadable { path: path.to_owned(), reason: error.to_string() }
    }

    pub(crate) fn other_kind(path: &Path, UnreadKind { found, advice }: UnreadKind) -> Self {
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

fn asked_episode(asked: Option<u64>) -> String {
    match asked {
        Some(episode) => format!("there is no episode {episode}"),
        None => "a run is one episode of the dataset".to_owned(),
    }
}

/// Episodes in their order, abbreviated.
fn episodes(found: &[u64]) -> String {
    match found {
        [] => "none".to_owned(),
        [only] => only.to_string(),
        [first, .., last] => format!("{} from {first} to {last}", found.len()),
    }
}

/// A number with at most about twenty characters.
fn short(value: f64) -> String {
    let is_tiny = value.abs() > 0.0 && value.abs() < 1e-6;
    let is_plain = !is_tiny && value.abs() < 1e15;
    if is_plain { format!("{value}") } else { format!("{value:e}") }
}

/// The first few names.
fn few(names: &[String]) -> String {
    const MOST: usize = 8;
    let more = names.len().saturating_sub(MOST);
    let first = list(&names[..names.len() - more]);
    if more == 0 { first } else { format!("{first} and {more} more") }
}
