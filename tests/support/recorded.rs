//! Recorded logs of real arms, which are not part of the project.

use std::path::{Path, PathBuf};

/// The folder of recorded logs: `PLUMBLINE_DATA`, or `shared/data` beside the project.
/// None, with a line on stdout, where there is none.
pub fn folder() -> Option<PathBuf> {
    let beside = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared/data");
    let folder = std::env::var_os("PLUMBLINE_DATA").map_or(beside, PathBuf::from);
    if !folder.is_dir() {
        println!("skipped: no recorded logs here (set PLUMBLINE_DATA to their folder)");
        return None;
    }
    Some(folder)
}
