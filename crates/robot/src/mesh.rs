use std::path::{Component, Path, PathBuf};

use crate::{Looks, RobotWarning, Shape, Visual};

/// Folders, from that of the URDF upwards, beside which a package is looked for.
const FOLDERS: usize = 5;
/// Largest mesh that is taken (bytes).
const LARGEST_MESH: u64 = 64 << 20;

impl Looks {
    /// Finds the files of the meshes; a mesh without one is left out.
    pub(crate) fn find_meshes(&mut self, urdf: &Path) -> Option<RobotWarning> {
        let mut missing = vec![];
        let mut has_file = |visual: &mut Visual| {
            let Shape::Mesh { file, .. } = &mut visual.shape else { return true };
            let found = candidates(file, urdf).into_iter().find(|path| usable(path));
            match found {
                Some(path) => *file = path,
                None => {
                    missing.push(file.display().to_string());
                    return false;
                }
            }
            true
        };
        self.links.iter_mut().chain([&mut self.base]).for_each(|v| v.retain_mut(&mut has_file));
        missing.sort();
        missing.dedup();
        let first = missing.first()?.clone();
        Some(RobotWarning::MeshesNotFound { first, count: missing.len() })
    }
}

/// Where a file that a URDF names may lie: where the name says, read from the URDF's folder.
///
/// A package is a folder of that name, which holds the URDF or lies beside it or beside a
/// folder above it. Nothing outside of a package is reached through its name.
fn candidates(name: &Path, urdf: &Path) -> Vec<PathBuf> {
    let name = name.to_string_lossy();
    let folder = urdf.parent().unwrap_or(Path::new(""));
    let Some(rest) = name.strip_prefix("package://") else {
        return vec![folder.join(name.strip_prefix("file://").unwrap_or(&name))];
    };
    let inside = |c: Component| matches!(c, Component::Normal(_) | Component::CurDir);
    if !Path::new(rest).components().all(inside) {
        return vec![];
    }
    // An empty path has no parent: it is the working folder.
    let folder = std::path::absolute(folder).unwrap_or_else(|_| folder.to_owned());
    folder.ancestors().take(FOLDERS).map(|f| f.join(rest)).collect()
}

fn usable(path: &Path) -> bool {
    std::fs::metadata(path).is_ok_and(|m| m.is_file() && m.len() <= LARGEST_MESH)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_package_is_looked_for_above_the_urdf_and_never_left() {
        let urdf = Path::new("/ws/arm_description/urdf/arm.urdf");
        let at = |name: &str| candidates(Path::new(name), urdf);
        let of_package = at("package://arm_description/meshes/a.stl");
        assert!(of_package.contains(&"/ws/arm_description/meshes/a.stl".into()));
        assert_eq!(at("package://arm_description/../../etc/a.stl"), Vec::<PathBuf>::new());
        assert_eq!(at("../meshes/a.stl"), [Path::new("/ws/arm_description/urdf/../meshes/a.stl")]);
        assert_eq!(at("file:///m/a.stl"), [Path::new("/m/a.stl")]);
    }
}
