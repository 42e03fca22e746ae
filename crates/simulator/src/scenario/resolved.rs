use std::path::{Path, PathBuf};

use document::{Document, KeyPath};

use crate::scenario::spec::ScenarioSpec;

/// The scenario as self-contained TOML that can be read from any folder.
pub(crate) fn resolve(document: &Document, spec: &ScenarioSpec) -> String {
    let mut spec = spec.clone();
    let folder = |path: &KeyPath| document.directory_of(path).to_owned();
    spec.robot = absolute(&folder(&KeyPath::root().key("robot")).join(&spec.robot));
    for (i, run) in spec.run.iter_mut().enumerate() {
        let path = KeyPath::root().key("run").index(i).key("motion");
        run.motion.anchor(&folder(&path));
    }
    toml::to_string(&spec).unwrap_or_else(|_| document.to_toml())
}

fn absolute(path: &Path) -> PathBuf {
    path.canonicalize().unwrap_or_else(|_| path.to_owned())
}
