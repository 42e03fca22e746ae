use std::path::{Path, PathBuf};
use std::{collections::BTreeSet, fs, io};

use crate::{
    common::{bounds::check_columns, damage::Damage, error::FormatError, unread_kinds::TWICE},
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
    joined_files::{JoinedFiles, RunFile, files_of_run},
};

/// Opens a file, the folder of a bag or a dataset, or several files of one run ([`files_of_run`]). The first bytes of a file
/// identify its kind.
///
/// `dataset` is the dataset at `path`, where it is open already. Its column of episodes is then not read again.
///
/// # Errors
///
/// The reason why the log cannot be read. `damage` says whether a damaged log is refused or cut off.
pub fn open(
    path: &Path,
    request: &Request,
    dataset: Option<&LerobotDataset>,
    damage: &mut Damage,
) -> Result<Box<dyn Opened>, FormatError> {
    if let Some(files) = files_of_run(path) {
        let open = |path: PathBuf| -> Result<RunFile, FormatError> {
            let log = open_one(&path, request, None, damage)?;
            Ok(RunFile { path, log })
        };
        let parts = files.into_iter().map(open).collect::<Result<_, _>>()?;
        return Ok(Box::new(JoinedFiles { parts }));
    }
    open_one(path, request, dataset, damage)
}

/// Opens a file, or the folder of a bag or a dataset.
fn open_one(
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

/// Names of the columns of the log at `path`, where each name must be unique.
///
/// # Errors
///
/// [`FormatError::DuplicateColumn`], [`FormatError::TooManyColumns`], and the errors of [`Opened::names`].
pub fn column_names(log: &dyn Opened, path: &Path) -> Result<Vec<String>, FormatError> {
    let names = log.names()?;
    check_columns(path, names.len())?;
    let mut seen = BTreeSet::new();
    match names.iter().find(|n| !n.is_empty() && !seen.insert(n.as_str())) {
        Some(name) => {
            Err(FormatError::DuplicateColumn { path: path.to_owned(), column: name.clone() })
        }
        None => Ok(names),
    }
}

impl LerobotDataset {
    /// The dataset in a folder; `None` where the path is not a dataset.
    ///
    /// # Errors
    ///
    /// The errors of reading the column `episode_index` of its files.
    pub fn open(path: &Path) -> Result<Option<Self>, FormatError> {
        Self::of_folder(path, &FORMATS)
    }
}
