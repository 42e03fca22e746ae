use std::io;

/// Why a named file cannot be read: what was found and what was expected, without the name and the content.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum FileError {
    /// Nothing has this name.
    #[error("there is no such file")]
    Missing,
    /// A folder has this name.
    #[error("it is a folder, a file was expected")]
    Folder,
    /// A pipe, a socket or a device has this name.
    #[error("it is a pipe, a socket or a device, a regular file was expected")]
    NotRegular,
    /// The file is larger than what it should be can be.
    #[error("it has {bytes} bytes, at most {most} were expected")]
    TooLarge {
        /// Size of the file (bytes).
        bytes: u64,
        /// Largest size that is read (bytes).
        most: u64,
    },
    /// The file is no text.
    #[error("line {line} is not UTF-8, a text was expected")]
    NotText {
        /// First line that is no text, from 1.
        line: usize,
        /// First byte that is no text, from 0.
        byte: usize,
    },
    /// The operating system cannot read it.
    #[error("{reason}")]
    Unreadable {
        /// What the operating system said.
        reason: String,
    },
}

impl From<io::Error> for FileError {
    fn from(error: io::Error) -> Self {
        match error.kind() {
            io::ErrorKind::NotFound => Self::Missing,
            _ => Self::Unreadable { reason: error.to_string() },
        }
    }
}

impl From<FileError> for io::Error {
    fn from(error: FileError) -> Self {
        let kind = match error {
            FileError::Missing => io::ErrorKind::NotFound,
            _ => io::ErrorKind::InvalidInput,
        };
        Self::new(kind, error.to_string())
    }
}
