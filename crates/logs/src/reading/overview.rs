use std::{
    collections::{BTreeMap, BTreeSet},
    path::Path,
};

use log_formats::{Damage, Needed, column_names, open};

use crate::{
    error::LogError,
    naming::time_name::times,
    reading::{
        options::ReadOptions,
        presets::{Fitting, fitting},
    },
    runs::run::{median, range},
};

/// A file by its columns, whatever they are called.
#[derive(Debug, Clone, PartialEq)]
pub struct FileOverview {
    /// Number of rows.
    pub rows: usize,
    /// The columns, in the order of the file.
    pub columns: Vec<ColumnOverview>,
    /// The preset column map that the columns fit.
    pub fitting: Option<Fitting>,
}

/// A column of a file.
#[derive(Debug, Clone, PartialEq)]
pub struct ColumnOverview {
    /// Name of the column.
    pub name: String,
    /// Lowest and highest value, in the unit of the file; `None` where a row has no finite number or the column is not as
    /// long as that of time.
    pub range: Option<(f64, f64)>,
    /// Median step from row to row, where the value rises in every row, as time does.
    pub rises_by: Option<f64>,
}

/// Largest number of lists, and of columns that some rows lack, that are read.
const MOST_LISTS: usize = 64;

/// Lists the columns of a file. Of `options` only topic, episode and dataset are used.
///
/// # Errors
///
/// [`LogError::File`] for a file that cannot be opened or decoded.
pub fn file_overview(path: &Path, options: &ReadOptions) -> Result<FileOverview, LogError> {
    let opened = |time| {
        let request = log_formats::Request { time, ..options.request() };
        open(path, &request, options.dataset, &mut Damage::default())
    };
    let names = column_names(opened("time")?.as_ref(), path)?;
    let time = times(&names).next().or(names.first()).cloned().unwrap_or_default();
    // Arrays are read along the axis of time.
    let file = opened(&time)?;
    let names = column_names(file.as_ref(), path)?;
    let load = |signals| {
        let needed = Needed { time: &time, signals, excerpt: None };
        file.load(&needed, &mut Damage::default())
    };
    let mut table = load(BTreeSet::new())?;
    // Entries of lists are read where they are needed, and what only some rows have is read from these.
    let mut lists: BTreeMap<&str, BTreeSet<&str>> = BTreeMap::new();
    for name in names.iter().filter(|name| !table.columns.contains_key(*name)) {
        let list = name.split_once('[').map_or(name.as_str(), |(list, _)| list);
        lists.entry(list).or_default().insert(name);
    }
    for entries in lists.into_values().take(MOST_LISTS) {
        let Ok(mut read) = load(entries.clone()) else { continue };
        for name in entries {
            table.columns.extend(read.columns.remove_entry(name));
        }
    }
    let overview = |name: &String| {
        let samples = table.columns.get(name).filter(|x| x.iter().all(|x| x.is_finite()));
        let samples = samples.map(Vec::as_slice).unwrap_or_default();
        let steps: Vec<f64> = samples.windows(2).map(|x| x[1] - x[0]).collect();
        let rises = !steps.is_empty() && steps.iter().all(|step| *step > 0.0);
        ColumnOverview {
            name: name.clone(),
            range: (!samples.is_empty()).then(|| range(samples)),
            rises_by: rises.then(|| median(&steps)),
        }
    };
    Ok(FileOverview {
        rows: table.columns.values().map(Vec::len).max().unwrap_or(0),
        columns: names.iter().filter(|name| !name.is_empty()).map(overview).collect(),
        fitting: fitting(&names)?,
    })
}
