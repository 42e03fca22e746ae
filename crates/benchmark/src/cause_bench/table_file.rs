use std::collections::BTreeSet;
use std::path::Path;

use log_formats::{Damage, Needed, Request, column_names, open};
use logs::LogError;

/// Name of the column of time.
pub(super) const TIME: &str = "time";

/// Columns of a file, in its order, all of one length.
pub(super) type NamedColumns = Vec<(String, Vec<f64>)>;

/// Every column of numbers of a table in any format that logs have.
///
/// # Errors
///
/// [`LogError::File`].
pub(super) fn read(path: &Path) -> Result<NamedColumns, LogError> {
    let request = Request { time: TIME, topic: None, episode: None };
    let opened = open(path, &request, None, &mut Damage::Refused)?;
    let names = column_names(&*opened, path)?;
    let signals: BTreeSet<&str> = names.iter().map(String::as_str).filter(|n| *n != TIME).collect();
    let needed = Needed { time: TIME, signals, excerpt: None };
    let mut table = opened.load(&needed, &mut Damage::Refused)?;
    let column = |name: String| table.columns.remove(&name).map(|column| (name, column));
    Ok(names.into_iter().filter_map(column).collect())
}
