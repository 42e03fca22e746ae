use std::{
    fs,
    path::{Path, PathBuf},
};

use crate::common::{error::FormatError, unread_kinds::NO_BAG_FILE};

/// What stands in a folder that is a bag.
const DESCRIPTION: &str = "metadata.yaml";
/// How files of a bag end, those that are packed have more behind it.
const ENDINGS: [&str; 2] = [".mcap", ".db3"];
/// How files of a database end that are no database.
const BESIDE: [&str; 3] = ["-wal", "-shm", "-journal"];

/// The files of the folder of a bag, in their order.
pub(crate) fn files_of(path: &Path) -> Result<Vec<PathBuf>, FormatError> {
    if !path.join(DESCRIPTION).is_file() {
        return Err(FormatError::NotAFile { path: path.to_owned(), found: "a directory" });
    }
    let unreadable = |e: std::io::Error| FormatError::unreadable(path, &e);
    let mut files = Vec::new();
    for entry in fs::read_dir(path).map_err(unreadable)? {
        let name = entry.map_err(unreadable)?.file_name().to_string_lossy().into_owned();
        let is_beside = BESIDE.iter().any(|end| name.ends_with(end));
        if !is_beside && ENDINGS.iter().any(|ending| name.contains(ending)) {
            files.push(name);
        }
    }
    if files.is_empty() {
        return Err(FormatError::other_kind(path, NO_BAG_FILE));
    }
    files.sort_by_key(|name| (number_of(name), name.clone()));
    Ok(files.iter().map(|name| path.join(name)).collect())
}

/// The number behind the last `_` of a name: files of a bag are counted so.
fn number_of(name: &str) -> u64 {
    let end = ENDINGS.iter().find_map(|ending| name.find(ending)).unwrap_or(name.len());
    let stem = &name[..end];
    stem.rsplit('_').next().and_then(|number| number.parse().ok()).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_are_in_the_order_of_their_numbers() {
        let mut names = ["arm_10.mcap", "arm_2.mcap.zstd", "arm_0.mcap"];
        names.sort_by_key(|name| number_of(name));
        assert_eq!(names, ["arm_0.mcap", "arm_2.mcap.zstd", "arm_10.mcap"]);
        assert_eq!([number_of("bag.mcap"), number_of("bag_3.db3")], [0, 3]);
    }
}
