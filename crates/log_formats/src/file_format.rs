//! What a reader of a kind of file offers.

use std::{fs::File, path::Path};

use crate::common::{
    damage::Damage,
    error::FormatError,
    table::{Needed, Table},
};

/// Bytes that files of a kind hold: how far from the first byte, and which.
pub(crate) type Magic = (usize, &'static [u8]);

/// Which part of a log is read, where it holds several.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Request<'a> {
    /// Name of the column of time: arrays whose axes are not told otherwise are as long as it.
    pub time: &'a str,
    /// The topic of a bag; `/joint_states`, or the only one of the type, where it is left out.
    pub topic: Option<&'a str>,
    /// The episode of a dataset; one that has a single episode needs none.
    pub episode: Option<u64>,
}

/// A kind of file.
pub(crate) trait FileFormat: Sync {
    /// What a file of the kind is called in an error.
    fn name(&self) -> &'static str;

    /// The bytes that tell the kind: a file that holds one of them is of it.
    fn magic(&self) -> &'static [Magic];

    /// The extension of files that are damaged where they hold other bytes than any known kind.
    fn extension(&self) -> Option<&'static str> {
        None
    }

    /// Opens a file, whose errors name `path`. A file that is damaged may be read up to there, as `damage` says.
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

/// A log that is open.
pub trait Opened {
    /// Names of the columns, in the order of the file. [`crate::column_names`] refuses those that are there twice.
    ///
    /// # Errors
    ///
    /// Those of a file that has to be decoded for its names.
    fn names(&self) -> Result<Vec<String>, FormatError>;

    /// The columns in `needed`, complete, and of the further ones those that are numbers in every row.
    ///
    /// # Errors
    ///
    /// Why a column in `needed` cannot be read, unless `damage` takes it.
    fn load(&self, needed: &Needed, damage: &mut Damage) -> Result<Table, FormatError>;

    /// SHA-256 in hexadecimal: of the file as it lies on the disk, or of its files one after the other.
    ///
    /// # Errors
    ///
    /// [`FormatError::Unreadable`].
    fn sha256(&self) -> Result<String, FormatError>;

    /// Whether the columns have no names of their own, but `column_1` and so on.
    fn is_unnamed(&self) -> bool {
        false
    }

    /// Whether the last row was cut off while it was written; it is left out.
    fn is_torn(&self) -> bool {
        false
    }
}
