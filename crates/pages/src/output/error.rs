use std::path::PathBuf;

/// Why a report cannot be made or written.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ReportError {
    /// A file or folder cannot be read.
    #[error("{}: {reason}", path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// What the operating system said.
        reason: String,
    },
    /// A file or folder cannot be written.
    #[error("{}: cannot be written: {reason}", path.display())]
    Unwritable {
        /// The file.
        path: PathBuf,
        /// What the operating system said.
        reason: String,
    },
    /// The output folder exists and is something else.
    #[error("{}: it is a file, a folder or a new name was expected", path.display())]
    NotAFolder {
        /// The path.
        path: PathBuf,
    },
    /// The result cannot be written in a format.
    #[error("the {format} of the report cannot be made: {reason}")]
    Format {
        /// `JSON`, `HTML` or `SVG`.
        format: &'static str,
        /// What the writer said.
        reason: String,
    },
}
