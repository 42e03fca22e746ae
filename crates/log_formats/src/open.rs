use std::{collections::BTreeSet, fs, io, path::Path};

use crate::{
    common::{damage::Damage, error::FormatError, unread_kinds::TWICE},
    content::Kind,
    file_format::{Opened, Request},
    formats::{
        FORMATS,
        bag::folder::open_folder,
        lerobot::{
            dataset::{LerobotDataset, is_dataset},
            episode::Episode,
        },
    },
};

/// Opens a file, or the folder of a bag or a dataset, whose kind the first bytes tell.
///
/// `dataset` is the one that `path` is, where it was opened already: its column of episodes is not read again.
///
/// # Errors
///
/// Why there is no log that can be read; `damage` says what becomes of one that is damaged.
pub fn open(
    path: &Path,
    request: &Request,
    dataset: Option<&LerobotDataset>,
    damage: &mut Damage,
) -> Result<Box<dyn Opened>, FormatError> {
    let data = fs::metadata(path).map_err(|e| match e.kind() {
        io::ErrorKind::NotFound => FormatError::Missing { path: path.to_owned() },
        _ => FormatError::unreadable(path, &e),
    })?;
    if data.is_dir() {
        return match is_dataset(path) {
            true => Ok(Box::new(Episode::open(path, request.episode, dataset, &FORMATS)?)),
            false => open_folder(path, request, &FORMATS, damage),
        };
    }
    if !data.is_file() {
        let found = "not a regular file";
        return Err(FormatError::NotAFile { path: path.to_owned(), found });
    }
    match FORMATS.content(path)? {
        (Kind::Read(format), file) => format.open(path, file, request, damage),
        (Kind::Packed(_), _) => Err(FormatError::other_kind(path, TWICE)),
    }
}

/// Names of the columns of the log at `path`, each one once.
///
/// # Errors
///
/// [`FormatError::DuplicateColumn`], and those of [`Opened::names`].
pub fn column_names(log: &dyn Opened, path: &Path) -> Result<Vec<String>, FormatError> {
    let names = log.names()?;
    let mut seen = BTreeSet::new();
    match names.iter().find(|n| !n.is_empty() && !seen.insert(n.as_str())) {
        Some(name) => {
            Err(FormatError::DuplicateColumn { path: path.to_owned(), column: name.clone() })
        }
        None => Ok(names),
    }
}

impl LerobotDataset {
    /// The dataset in a folder; `None` where a path is none.
    ///
    /// # Errors
    ///
    /// Those of reading the column `episode_index` of its files.
    pub fn open(path: &Path) -> Result<Option<Self>, FormatError> {
        Self::of_folder(path, &FORMATS)
    }
}
