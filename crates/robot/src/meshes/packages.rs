use std::collections::BTreeMap;
use std::ffi::OsStr;
use std::path::{Path, PathBuf};

/// Where the packages are that the meshes of a URDF lie in (`package://NAME/...`).
///
/// ROS finds a package by its name in folders that variables of the environment list; the
/// meshes are only for looks, so that a package that is not found is a warning.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Packages {
    /// Folders by the name of the package, which count before all others.
    pub named: BTreeMap<String, PathBuf>,
    /// Folders that hold packages or are one, as in `ROS_PACKAGE_PATH`.
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

    /// Folders in which the package `name` may be, the first that holds a file counts.
    pub(crate) fn folders(&self, name: &str) -> Vec<PathBuf> {
        let named = self.named.get(name).cloned();
        let is_it = |folder: &&PathBuf| folder.file_name() == Some(OsStr::new(name));
        let itself = self.ros_paths.iter().filter(is_it).cloned();
        let inside = self.ros_paths.iter().map(|folder| folder.join(name));
        let ament = self.ament_prefixes.iter().map(|prefix| prefix.join("share").join(name));
        named.into_iter().chain(itself).chain(inside).chain(ament).collect()
    }

    /// The files that `package://NAME/inside` may mean.
    pub(crate) fn candidates(&self, name: &str, inside: &Path) -> Vec<PathBuf> {
        self.folders(name).iter().map(|folder| folder.join(inside)).collect()
    }
}
