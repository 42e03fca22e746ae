//! Files of the checkout.

use std::fs;
use std::path::{Path, PathBuf};

/// The folder of the workspace's manifest.
pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap().to_owned()
}

/// The text of a file, named from the root.
pub fn text(path: &str) -> String {
    let path = root().join(path);
    fs::read_to_string(&path).map_err(|error| (path, error)).unwrap()
}

/// The folders directly in `folder` (named from the root), by name.
pub fn folders(folder: &str) -> Vec<String> {
    let entries = fs::read_dir(root().join(folder)).unwrap().map(Result::unwrap);
    let mut names: Vec<String> = entries
        .filter(|entry| entry.path().is_dir())
        .map(|entry| entry.file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

/// The Rust files in and below `folder`, named from the root.
pub fn rust_files(folder: &str) -> Vec<String> {
    files(folder, |path| path.ends_with(".rs"))
}

/// The files in and below `folder` (where it is there) whose path is `wanted`, named from the root.
pub fn files(folder: &str, wanted: impl Fn(&str) -> bool) -> Vec<String> {
    let mut files = Vec::new();
    if !root().join(folder).exists() {
        return files;
    }
    let mut open = vec![folder.to_owned()];
    while let Some(folder) = open.pop() {
        let entries = fs::read_dir(root().join(&folder)).unwrap().map(Result::unwrap);
        for entry in entries {
            let path = format!("{folder}/{}", entry.file_name().into_string().unwrap());
            if entry.path().is_dir() {
                open.push(path);
            } else if wanted(&path) {
                files.push(path);
            }
        }
    }
    files.sort();
    files
}
