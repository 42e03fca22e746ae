//! Interface of the readers of all kinds of file.

use std::{fs::File, path::Path};

use crate::common::{
    damage::Damage,
    error::FormatError,
    table::{Needed, Table},
};

/// Bytes that identify a kind of file: distance from the first byte, and the bytes.
pub(crate) type Magic = (usize, &'static [u8]);

/// The part of a log that is read, where it holds several.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Request<'a> {
    /// Name of the column of time. An array whose axes are not known otherwise is as long as this column.
    pub time: &'a str,
    /// The topic of a bag. By default it is `/joint_states`, or else the only topic of the type.
    pub topic: Option<&'a str>,
    /// The episode of a dataset; it may be left out for a dataset with a single episode.
    pub episode: Option<u64>,
}

/// A kind of file.
pub(crate) trait FileFormat: Sync {
    /// Name of the kind in errors.
    fn name(&self) -> &'static str;

    /// The bytes that identify the kind: a file of the kind has one of them.
    fn magic(&self) -> &'static [Magic];

    /// The extension of the kind. A file with this extension but without the bytes of any known kind is damaged.
    fn extension(&self) -> Option<&'static str> {
        None
    }

    /// Opens a file; errors name `path`. `damage` says whether a damaged file is read up to the damage.
    ///
    /// # Errors
    ///
    /// Why the file cannot be used.
    fn open(
        &self,
        path: &Path,
        file: File,
        request: &Request,
        damage: &mut Damage,
    ) -> Result<Box<dyn Opened>, FormatError>;
}

/// An open log.
pub trait Opened {
    /// Names of the columns, in the order of the file. [`crate::column_names`] refuses names that occur twice.
    ///
    /// # Errors
    ///
    /// Errors of decoding, for a file that must be decoded to know its names.
    fn names(&self) -> Result<Vec<String>, FormatError>;

    /// The columns in `needed`, with a number in every row, and any other column with a number in every row.
    ///
    /// # Errors
    ///
    /// The reason why a column in `needed` cannot be read, unless `damage` cuts the log off there.
    fn load(&self, needed: &Needed, damage: &mut Damage) -> Result<Table, FormatError>;

    /// SHA-256 in hexadecimal, of the file on the disk, or of all files of the log in sequence.
    ///
    /// # Errors
    ///
    /// [`FormatError::Unreadable`].
    fn sha256(&self) -> Result<String, FormatError>;

    /// Whether the file gives its columns no names. They are then called `column_1` and so on.
    fn is_unnamed(&self) -> bool {
        false
    }

    /// Whether the last row was cut off while it was written. That row is left out.
    fn is_torn(&self) -> bool {
        false
    }
}
