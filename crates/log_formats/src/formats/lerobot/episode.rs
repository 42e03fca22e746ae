use std::{collections::BTreeMap, ops::Range, path::Path, sync::Arc};

use serde::Deserialize;
use serde_json::Value;

use crate::{
    common::{
        damage::Damage,
        error::FormatError,
        sha256::sha256_of_files,
        table::{Needed, Table},
    },
    content::Formats,
    file_format::Opened,
    formats::{
        lerobot::dataset::{DESCRIPTION, DataFile, LerobotDataset, open},
        parquet::{list_column::part_name, parquet_file::ParquetFile},
    },
};

/// Name of the format in errors.
const NAME: &str = "LeRobot";
/// Largest part of a description that is read (bytes).
const LONGEST_DESCRIPTION: u64 = 1 << 24;
/// One episode of a dataset.
pub(crate) struct Episode {
    /// The files with rows of the episode, and these rows.
    files: Vec<(Arc<DataFile>, ParquetFile, Vec<Range<usize>>)>,
    names: Vec<String>,
    /// Names of columns by joint, with their names in the files.
    by_joint: BTreeMap<String, String>,
}

/// The used part of `meta/info.json`.
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

impl Episode {
    /// Opens an episode. The episode may be left out for a dataset with a single one. `dataset` is the dataset at
    /// `path`, where it is open already.
    pub(crate) fn open(
        path: &Path,
        episode: Option<u64>,
        dataset: Option<&LerobotDataset>,
        formats: &Formats,
    ) -> Result<Self, FormatError> {
        let known = dataset.filter(|dataset| dataset.folder == path).cloned();
        let dataset = known.map_or_else(
            || LerobotDataset::of_folder(path, formats),
            |dataset| Ok(Some(dataset)),
        )?;
        let found = dataset.as_ref().map(LerobotDataset::episodes).unwrap_or_default();
        let wanted = match (episode, found.as_slice()) {
            (Some(episode), found) if found.contains(&episode) => episode,
            (None, [only]) => *only,
            (asked, found) => {
                let (path, found) = (path.to_owned(), found.to_vec());
                return Err(FormatError::Episode { path, asked, found });
            }
        };
        let mut files = Vec::new();
        for file in dataset.into_iter().flat_map(|dataset| dataset.files) {
            if let Some(rows) = file.rows.get(&wanted).cloned() {
                let parquet = open(&file.path, formats)?;
                files.push((file, parquet, rows));
            }
        }
        let mut names = files.first().map_or(Ok(Vec::new()), |(_, file, _)| file.names())?;
        let by_joint = by_joint(&read_info(path)?, &names);
        names.extend(by_joint.keys().cloned());
        Ok(Self { files, names, by_joint })
    }
}

impl Opened for Episode {
    /// `action[0]` and so on, and also `action[elbow]` where the joint is named.
    fn names(&self) -> Result<Vec<String>, FormatError> {
        Ok(self.names.clone())
    }

    fn load(&self, needed: &Needed, _: &mut Damage) -> Result<Table, FormatError> {
        let in_file = |name: &'_ str| self.by_joint.get(name).map_or(name.to_owned(), Clone::clone);
        let signals: Vec<String> = needed.signals.iter().map(|name| in_file(name)).collect();
        let time = in_file(needed.time);
        let signals = signals.iter().map(String::as_str).collect();
        let asked = Needed { time: &time, signals, excerpt: None };
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

    /// SHA-256 in hexadecimal of the files with rows of the episode, in sequence. Where one file has all of these rows
    /// its SHA-256 is computed once per dataset.
    fn sha256(&self) -> Result<String, FormatError> {
        let all = || sha256_of_files(self.files.iter().map(|(_, file, _)| file.path()));
        let [(file, ..)] = self.files.as_slice() else { return all() };
        if let Some(hash) = file.sha256.get() {
            return Ok(hash.clone());
        }
        let hash = all()?;
        Ok(file.sha256.get_or_init(|| hash).clone())
    }
}

fn read_info(path: &Path) -> Result<Info, FormatError> {
    let path = path.join(DESCRIPTION);
    let text = files::text(&path, LONGEST_DESCRIPTION);
    let text = text.map_err(|e| FormatError::unreadable(&path, &e))?;
    serde_json::from_str(&text).map_err(|e| FormatError::broken(&path, NAME, &e))
}

/// Maps `action[elbow]` to `action[2]` where the third name of `action` is that of the joint `elbow`.
fn by_joint(info: &Info, columns: &[String]) -> BTreeMap<String, String> {
    let mut by_joint = BTreeMap::new();
    for (feature, Feature { names }) in &info.features {
        for (k, name) in names_in(names).into_iter().enumerate() {
            let (own, named) = (part_name(feature, k), format!("{feature}[{}]", joint_of(name)));
            if columns.contains(&own) && !columns.contains(&named) {
                by_joint.entry(named).or_insert(own);
            }
        }
    }
    by_joint
}

/// The names of a feature: a list, or a list in a table such as `{ motors = [...] }`.
fn names_in(names: &Value) -> Vec<&str> {
    match names {
        Value::Array(list) => list.iter().map(|name| name.as_str().unwrap_or_default()).collect(),
        Value::Object(table) => table.values().flat_map(names_in).collect(),
        _ => Vec::new(),
    }
}

/// The joint in a name such as `elbow.pos` or `main_elbow`.
fn joint_of(name: &str) -> &str {
    const QUANTITIES: [&str; 6] = [".pos", ".position", ".vel", ".velocity", ".effort", ".torque"];
    let stem = QUANTITIES.iter().find_map(|end| name.strip_suffix(end)).unwrap_or(name);
    stem.strip_prefix("main_").unwrap_or(stem)
}
