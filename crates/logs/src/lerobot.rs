//! Datasets of LeRobot, versions 2 and 3: a folder with `meta/info.json` and `data/**/*.parquet`.

use std::{
    collections::{BTreeMap, BTreeSet},
    fs::{self, File},
    io::Read,
    ops::Range,
    path::{Path, PathBuf},
    sync::{Arc, OnceLock},
};

use serde::Deserialize;
use serde_json::Value;

use crate::{
    LogError,
    content::content,
    kind::{Kind, NOT_PARQUET},
    list_column::part_name,
    log_file::sha256_of,
    parquet_file::ParquetFile,
    table::{Needed, Table},
};

/// What stands in a folder that is a dataset.
const DESCRIPTION: &str = "meta/info.json";
/// What a damaged description is called.
const KIND: &str = "LeRobot";
/// A description is not read beyond this (bytes).
const LONGEST_DESCRIPTION: u64 = 1 << 24;
/// Folders below `data` that are looked into.
const DEEPEST: usize = 3;
/// The column that tells the rows of an episode.
const EPISODE: &str = "episode_index";

/// A dataset of LeRobot: which rows of its files each episode is.
#[derive(Debug, Clone, PartialEq)]
pub struct Dataset {
    folder: PathBuf,
    files: Vec<Arc<DataFile>>,
}

/// A file of a dataset.
#[derive(Debug, PartialEq)]
struct DataFile {
    path: PathBuf,
    /// The rows of every episode.
    rows: BTreeMap<u64, Vec<Range<usize>>>,
    /// SHA-256 in hexadecimal, once it was asked for.
    sha256: OnceLock<String>,
}

/// One episode of a dataset.
pub(crate) struct LeRobot {
    /// The files that hold rows of it, with these rows.
    files: Vec<(Arc<DataFile>, ParquetFile, Vec<Range<usize>>)>,
    names: Vec<String>,
    /// Columns that are called by the name of a joint, with their name in the files.
    by_joint: BTreeMap<String, String>,
}

/// What is read of `meta/info.json`.
#[derive(Deserialize)]
struct Info {
    features: BTreeMap<String, Feature>,
}

/// One column of the dataset.
#[derive(Deserialize)]
struct Feature {
    #[serde(default)]
    names: Value,
}

/// Whether a folder is a dataset.
pub(crate) fn is_dataset(path: &Path) -> bool {
    path.join(DESCRIPTION).is_file()
}

impl Dataset {
    /// The dataset in a folder; `None` where a path is none.
    ///
    /// # Errors
    ///
    /// Those of reading the column `episode_index` of its files.
    pub fn open(path: &Path) -> Result<Option<Self>, LogError> {
        if !is_dataset(path) {
            return Ok(None);
        }
        let mut files = Vec::new();
        for path in files_of(path)? {
            let rows = episodes_of(&open(&path)?)?;
            files.push(Arc::new(DataFile { path, rows, sha256: OnceLock::new() }));
        }
        Ok(Some(Self { folder: path.to_owned(), files }))
    }

    /// The numbers of its episodes, in their order.
    pub fn episodes(&self) -> Vec<u64> {
        let all: BTreeSet<u64> =
            self.files.iter().flat_map(|file| file.rows.keys().copied()).collect();
        all.into_iter().collect()
    }
}

impl LeRobot {
    /// Looks for the rows of an episode, which may be left out where there is one only; `dataset` is that of `path`,
    /// where it is known.
    pub(crate) fn open(
        path: &Path,
        episode: Option<u64>,
        dataset: Option<&Dataset>,
    ) -> Result<Self, LogError> {
        let known = dataset.filter(|dataset| dataset.folder == path).cloned();
        let dataset = known.map_or_else(|| Dataset::open(path), |dataset| Ok(Some(dataset)))?;
        let found = dataset.as_ref().map(Dataset::episodes).unwrap_or_default();
        let wanted = match (episode, found.as_slice()) {
            (Some(episode), found) if found.contains(&episode) => episode,
            (None, [only]) => *only,
            (asked, found) => {
                let (path, found) = (path.to_owned(), found.to_vec());
                return Err(LogError::Episode { path, asked, found });
            }
        };
        let mut files = Vec::new();
        for file in dataset.into_iter().flat_map(|dataset| dataset.files) {
            if let Some(rows) = file.rows.get(&wanted).cloned() {
                let parquet = open(&file.path)?;
                files.push((file, parquet, rows));
            }
        }
        let mut names = files.first().map_or(Ok(Vec::new()), |(_, file, _)| file.names())?;
        let by_joint = by_joint(&read_info(path)?, &names);
        names.extend(by_joint.keys().cloned());
        Ok(Self { files, names, by_joint })
    }

    /// Names of the columns: `action[0]` and so on, and `action[elbow]` where a joint is named.
    pub(crate) fn names(&self) -> &[String] {
        &self.names
    }

    /// Columns by name, those in `needed` complete.
    pub(crate) fn load(&self, needed: &Needed) -> Result<Table, LogError> {
        let in_file = |name: &'_ str| self.by_joint.get(name).map_or(name.to_owned(), Clone::clone);
        let signals: Vec<String> = needed.signals.iter().map(|name| in_file(name)).collect();
        let time = in_file(needed.time);
        let signals = signals.iter().map(String::as_str).collect();
        let asked = Needed { time: &time, signals, excerpted: None };
        let mut columns: BTreeMap<String, Vec<f64>> = BTreeMap::new();
        let mut rows = 0;
        for (_, file, ranges) in &self.files {
            let table = file.load_rows(&asked, Some(ranges))?;
            // A column that is not whole in every file is none.
            columns.retain(|name, _| table.columns.contains_key(name));
            for (name, samples) in table.columns {
                if rows == 0 || columns.contains_key(&name) {
                    columns.entry(name).or_default().extend(samples);
                }
            }
            rows += ranges.iter().map(ExactSizeIterator::len).sum::<usize>();
        }
        for name in &needed.signals {
            if let Some(samples) = self.by_joint.get(*name).and_then(|own| columns.get(own)) {
                columns.insert((*name).to_owned(), samples.clone());
            }
        }
        let is_other_name =
            |name: &String| !needed.contains(name) && self.by_joint.values().any(|own| own == name);
        columns.retain(|name, _| !is_other_name(name));
        Ok(Table { columns, ..Table::default() }.excerpt(needed))
    }

    /// SHA-256 of the files that hold rows of the episode, one after the other, in hexadecimal. That of a file which
    /// holds all of them is worked out once for the dataset.
    pub(crate) fn sha256(&self) -> Result<String, LogError> {
        let all = || sha256_of(self.files.iter().map(|(_, file, _)| file.path().to_owned()));
        let [(file, ..)] = self.files.as_slice() else { return all() };
        if let Some(hash) = file.sha256.get() {
            return Ok(hash.clone());
        }
        let hash = all()?;
        Ok(file.sha256.get_or_init(|| hash).clone())
    }
}

/// The rows of every episode in a file.
fn episodes_of(file: &ParquetFile) -> Result<BTreeMap<u64, Vec<Range<usize>>>, LogError> {
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

fn open(path: &Path) -> Result<ParquetFile, LogError> {
    match content(path)? {
        (Kind::Parquet, file) => Ok(ParquetFile::open(path, file)),
        _ => Err(LogError::other_kind(path, NOT_PARQUET)),
    }
}

/// The data files of a dataset, in the order of their names.
fn files_of(path: &Path) -> Result<Vec<PathBuf>, LogError> {
    let mut files = Vec::new();
    collect(&path.join("data"), DEEPEST, &mut files)?;
    files.sort();
    Ok(files)
}

fn collect(folder: &Path, depth: usize, files: &mut Vec<PathBuf>) -> Result<(), LogError> {
    let unreadable = |e: std::io::Error| LogError::unreadable(folder, &e);
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

fn read_info(path: &Path) -> Result<Info, LogError> {
    let path = path.join(DESCRIPTION);
    let mut text = String::new();
    let file = File::open(&path).map_err(|e| LogError::unreadable(&path, &e))?;
    let read = file.take(LONGEST_DESCRIPTION).read_to_string(&mut text);
    read.map_err(|e| LogError::unreadable(&path, &e))?;
    serde_json::from_str(&text).map_err(|e| LogError::broken(&path, KIND, &e))
}

/// `action[elbow]` for `action[2]` where the third name of `action` is that of the joint `elbow`.
fn by_joint(info: &Info, columns: &[String]) -> BTreeMap<String, String> {
    let mut by_joint = BTreeMap::new();
    for (feature, Feature { names }) in &info.features {
        for (k, name) in listed(names).into_iter().enumerate() {
            let (own, named) = (part_name(feature, k), format!("{feature}[{}]", joint_of(name)));
            if columns.contains(&own) && !columns.contains(&named) {
                by_joint.entry(named).or_insert(own);
            }
        }
    }
    by_joint
}

/// The names of a feature, a list or one in a table such as `{ motors = [...] }`.
fn listed(names: &Value) -> Vec<&str> {
    match names {
        Value::Array(list) => list.iter().map(|name| name.as_str().unwrap_or_default()).collect(),
        Value::Object(table) => table.values().flat_map(listed).collect(),
        _ => Vec::new(),
    }
}

/// The joint that a name such as `elbow.pos` or `main_elbow` speaks of.
fn joint_of(name: &str) -> &str {
    const QUANTITIES: [&str; 6] = [".pos", ".position", ".vel", ".velocity", ".effort", ".torque"];
    let stem = QUANTITIES.iter().find_map(|end| name.strip_suffix(end)).unwrap_or(name);
    stem.strip_prefix("main_").unwrap_or(stem)
}
