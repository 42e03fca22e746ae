use std::{
    fs,
    path::{Path, PathBuf},
};

use crate::common::{error::FormatError, unread_kinds::NO_BAG_FILE};

/// The file that marks a folder as a bag.
const DESCRIPTION: &str = "metadata.yaml";
/// Extensions of the files of a bag. Packed files have another one after it.
const ENDINGS: [&str; 2] = [".mcap", ".db3"];
/// Ends of the names of files beside a database that are not databases.
const BESIDE: [&str; 3] = ["-wal", "-shm", "-journal"];

/// The files in the folder of a bag, ordered by their numbers.
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

/// The number after the last `_` of a name, by which the files of a bag are ordered.
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
