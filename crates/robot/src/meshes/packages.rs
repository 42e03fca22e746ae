use std::collections::BTreeMap;
use std::ffi::OsStr;
use std::path::{Path, PathBuf};

/// Where packages of meshes (`package://NAME/...`) are looked for.
///
/// ROS finds a package by name in the folders that environment variables list. Meshes are for
/// display alone, so a missing package is only a warning.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Packages {
    /// Folders by the name of the package; they take precedence.
    pub named: BTreeMap<String, PathBuf>,
    /// Folders that are packages or contain packages, as in `ROS_PACKAGE_PATH`.
    pub ros_paths: Vec<PathBuf>,
    /// Folders that hold packages under `share`, as in `AMENT_PREFIX_PATH`.
    pub ament_prefixes: Vec<PathBuf>,
}

impl Packages {
    /// The folders that the values of `ROS_PACKAGE_PATH` and `AMENT_PREFIX_PATH` list.
    pub fn from_paths(ros_paths: Option<&OsStr>, ament_prefixes: Option<&OsStr>) -> Self {
        let folders = |list: Option<&OsStr>| -> Vec<PathBuf> {
            let all = list.into_iter().flat_map(std::env::split_paths);
            all.filter(|folder| !folder.as_os_str().is_empty()).collect()
        };
        Self {
            named: BTreeMap::new(),
            ros_paths: folders(ros_paths),
            ament_prefixes: folders(ament_prefixes),
        }
    }

    /// Candidate folders of the package `name`; the first that holds the file is used.
    pub(crate) fn folders(&self, name: &str) -> Vec<PathBuf> {
        let named = self.named.get(name).cloned();
        let is_it = |folder: &&PathBuf| folder.file_name() == Some(OsStr::new(name));
        let itself = self.ros_paths.iter().filter(is_it).cloned();
        let inside = self.ros_paths.iter().map(|folder| folder.join(name));
        let ament = self.ament_prefixes.iter().map(|prefix| prefix.join("share").join(name));
        named.into_iter().chain(itself).chain(inside).chain(ament).collect()
    }

    /// Candidate files for `package://NAME/inside`.
    pub(crate) fn candidates(&self, name: &str, inside: &Path) -> Vec<PathBuf> {
        self.folders(name).iter().map(|folder| folder.join(inside)).collect()
    }
}
