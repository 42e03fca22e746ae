use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use sha2::{Digest, Sha256};

use crate::common::damage::Damage;
use crate::common::error::FormatError;
use crate::common::sha256::hexadecimal;
use crate::common::table::{Needed, Table};
use crate::file_format::Opened;

/// Between the names of files that are one run.
const BETWEEN: char = '+';

/// The files of a run whose columns lie in several, such as `run/q.mat+tau.mat+t.mat`: the first, and the others beside it or
/// at paths of their own. `None` for the path of one file, also of one with that character in its name.
pub fn files_of_run(path: &Path) -> Option<Vec<PathBuf>> {
    let text = path.to_str().filter(|text| text.contains(BETWEEN) && !path.exists())?;
    let mut names = text.split(BETWEEN);
    let first = PathBuf::from(names.next()?);
    if !first.exists() {
        return None;
    }
    let folder = first.parent().unwrap_or(Path::new("")).to_owned();
    let place = |name: &str| {
        let beside = folder.join(name);
        if beside.exists() { beside } else { PathBuf::from(name) }
    };
    let others: Vec<PathBuf> = names.map(place).collect();
    Some(std::iter::once(first).chain(others).collect())
}

/// The path of a run, in which files beside the first have their name alone.
pub fn path_of_run(path: &Path) -> PathBuf {
    let Some(files) = files_of_run(path) else { return path.to_owned() };
    let mut text = String::new();
    for file in &files {
        let is_beside = !text.is_empty() && file.parent() == files[0].parent();
        let name = if is_beside { file.file_name().map(Path::new) } else { None };
        if !text.is_empty() {
            text.push(BETWEEN);
        }
        text.push_str(&name.unwrap_or(file).to_string_lossy());
    }
    text.into()
}

/// The name of a run: that of its file, or of its files in a row, without extensions.
pub fn name_of_run(path: &Path) -> String {
    let files = files_of_run(path).unwrap_or_else(|| vec![path.to_owned()]);
    let names: Vec<String> = files
        .iter()
        .map(|file| file.file_stem().unwrap_or_default().to_string_lossy().into_owned())
        .collect();
    names.join("+")
}

/// Whether a log is there: a file, a folder, or all files of a run in several.
pub fn is_there(path: &Path) -> bool {
    path.exists() || files_of_run(path).is_some_and(|files| files.iter().all(|file| file.exists()))
}

/// The files of one run, row by row beside one another.
///
/// Columns of a file that gives them no names have that of the file: `tau.csv` of seven columns has `tau[0]` to `tau[6]`, of one
/// column `tau`. A column that several files have, as each may have time, must be the same in all.
pub(crate) struct JoinedFiles {
    pub parts: Vec<RunFile>,
}

/// A file of a run.
pub(crate) struct RunFile {
    pub path: PathBuf,
    pub log: Box<dyn Opened>,
}

impl RunFile {
    /// The names of its columns, in the file and in the run.
    fn names(&self) -> Result<Vec<(String, String)>, FormatError> {
        let own = self.log.names()?;
        if !self.log.is_unnamed() {
            return Ok(own.into_iter().map(|name| (name.clone(), name)).collect());
        }
        let stem = self.path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let single = own.len() == 1;
        let name = |(k, own): (usize, String)| match single {
            true => (own, stem.clone()),
            false => (own, format!("{stem}[{k}]")),
        };
        Ok(own.into_iter().enumerate().map(name).collect())
    }

    /// The columns of the file that are needed, by their names in the run.
    fn load(&self, needed: &Needed, damage: &mut Damage) -> Result<Table, FormatError> {
        let names = self.names()?;
        let wanted = names.iter().filter(|(_, name)| needed.contains(name));
        let own: Vec<&str> = wanted.map(|(own, _)| own.as_str()).collect();
        let of_time = names.iter().find(|(_, name)| name == needed.time);
        let Some(time) = of_time.map(|(own, _)| own.as_str()).or(own.first().copied()) else {
            return Ok(Table::default());
        };
        let signals = own.into_iter().filter(|own| *own != time).collect();
        let mut table = self.log.load(&Needed { time, signals, excerpt: None }, damage)?;
        let taken = names.into_iter().filter_map(|(own, name)| {
            let column = table.columns.remove(&own)?;
            Some((name, column))
        });
        Ok(Table { columns: taken.collect(), ..Table::default() })
    }
}

impl Opened for JoinedFiles {
    fn names(&self) -> Result<Vec<String>, FormatError> {
        let mut all: Vec<String> = Vec::new();
        for part in &self.parts {
            let new: Vec<String> = part.names()?.into_iter().map(|(_, name)| name).collect();
            let new = new.into_iter().filter(|name| !all.contains(name)).collect::<Vec<_>>();
            all.extend(new);
        }
        Ok(all)
    }

    fn load(&self, needed: &Needed, damage: &mut Damage) -> Result<Table, FormatError> {
        let mut columns: BTreeMap<String, Vec<f64>> = BTreeMap::new();
        let mut first: Option<(String, usize)> = None;
        for part in &self.parts {
            for (name, column) in part.load(needed, damage)?.columns {
                let (before, expected) =
                    first.get_or_insert_with(|| (name.clone(), column.len())).clone();
                if column.len() != expected {
                    return Err(FormatError::ColumnLength {
                        path: part.path.clone(),
                        column: name,
                        found: column.len() as u64,
                        time: before,
                        expected: expected as u64,
                    });
                }
                match columns.get(&name) {
                    Some(known) if *known != column => {
                        return Err(FormatError::OtherColumn {
                            path: part.path.clone(),
                            column: name,
                        });
                    }
                    _ => {
                        columns.insert(name, column);
                    }
                }
            }
        }
        Ok(Table { columns, ..Table::default() }.excerpt(needed))
    }

    /// SHA-256 of those of the files, in their order.
    fn sha256(&self) -> Result<String, FormatError> {
        let mut hasher = Sha256::new();
        for part in &self.parts {
            hasher.update(part.log.sha256()?);
        }
        Ok(hexadecimal(hasher))
    }
}
