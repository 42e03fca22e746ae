use std::path::PathBuf;

/// Why an answer, or a part of it, counts as nothing said.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{}: {place}{found} was found, {expected} was expected", path.display())]
pub struct AnswerFault {
    /// The file.
    pub path: PathBuf,
    /// The key at fault, such as `names[2].joint: `; empty for the whole file.
    pub place: String,
    /// What was found.
    pub found: String,
    /// What was expected.
    pub expected: String,
    /// The disk failed: nothing is known of the answer.
    pub is_unread: bool,
}
