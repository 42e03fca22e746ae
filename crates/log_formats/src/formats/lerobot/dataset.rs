use std::{
    collections::{BTreeMap, BTreeSet},
    fs,
    ops::Range,
    path::{Path, PathBuf},
    sync::{Arc, OnceLock},
};

use crate::{
    common::{error::FormatError, unread_kinds::NOT_PARQUET},
    content::{Formats, Kind},
    file_format::FileFormat,
    formats::parquet::parquet_file::{Parquet, ParquetFile},
};

/// The file that marks a folder as a dataset.
pub(crate) const DESCRIPTION: &str = "meta/info.json";
/// Most levels of folders that are read below `data`.
const DEEPEST: usize = 3;
/// The column with the episode of each row.
const EPISODE: &str = "episode_index";

/// A LeRobot dataset, with the rows of each episode in its files.
#[derive(Debug, Clone, PartialEq)]
pub struct LerobotDataset {
    pub(crate) folder: PathBuf,
    pub(crate) files: Vec<Arc<DataFile>>,
}

/// A file of a dataset.
#[derive(Debug, PartialEq)]
pub(crate) struct DataFile {
    pub path: PathBuf,
    /// The rows of every episode.
    pub rows: BTreeMap<u64, Vec<Range<usize>>>,
    /// SHA-256 in hexadecimal, once it was computed.
    pub sha256: OnceLock<String>,
}

/// Whether a folder is a dataset.
pub(crate) fn is_dataset(path: &Path) -> bool {
    path.join(DESCRIPTION).is_file()
}

impl LerobotDataset {
    /// The dataset in a folder; `None` where the path is not a dataset.
    pub(crate) fn of_folder(path: &Path, formats: &Formats) -> Result<Option<Self>, FormatError> {
        if !is_dataset(path) {
            return Ok(None);
        }
        let mut files = Vec::new();
        for path in files_of(path)? {
            let rows = episodes_of(&open(&path, formats)?)?;
            files.push(Arc::new(DataFile { path, rows, sha256: OnceLock::new() }));
        }
        Ok(Some(Self { folder: path.to_owned(), files }))
    }

    /// Numbers of the episodes, in rising order.
    pub fn episodes(&self) -> Vec<u64> {
        let all: BTreeSet<u64> =
            self.files.iter().flat_map(|file| file.rows.keys().copied()).collect();
        all.into_iter().collect()
    }
}

/// The rows of every episode in a file.
fn episodes_of(file: &ParquetFile) -> Result<BTreeMap<u64, Vec<Range<usize>>>, FormatError> {
    let mut rows: BTreeMap<u64, Vec<Range<usize>>> = BTreeMap::new();
    for (row, number) in file.load_column(EPISODE)?.into_iter().enumerate() {
        let ranges = rows.entry(number as u64).or_default();
        match ranges.last_mut() {
            Some(last) if last.end == row => last.end = row + 1,
            _ => ranges.push(row..row + 1),
        }
    }
    Ok(rows)
}

pub(crate) fn open(path: &Path, formats: &Formats) -> Result<ParquetFile, FormatError> {
    match formats.content(path)? {
        (Kind::Read(format), file) if format.name() == Parquet.name() => {
            Ok(ParquetFile::open(path, file))
        }
        _ => Err(FormatError::other_kind(path, NOT_PARQUET)),
    }
}

/// The data files of a dataset, in the order of their names.
fn files_of(path: &Path) -> Result<Vec<PathBuf>, FormatError> {
    let mut files = Vec::new();
    collect(&path.join("data"), DEEPEST, &mut files)?;
    files.sort();
    Ok(files)
}

fn collect(folder: &Path, depth: usize, files: &mut Vec<PathBuf>) -> Result<(), FormatError> {
    let unreadable = |e: std::io::Error| FormatError::unreadable(folder, &e);
    for entry in fs::read_dir(folder).map_err(unreadable)? {
        let path = entry.map_err(unreadable)?.path();
        if path.is_dir() && depth > 1 {
            collect(&path, depth - 1, files)?;
        } else if path.is_file() && path.extension().is_some_and(|e| e == "parquet") {
            files.push(path);
        }
    }
    Ok(())
}
