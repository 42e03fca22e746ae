use std::path::{Component, Path, PathBuf};

use crate::meshes::folders::MeshFolders;
use crate::meshes::kind::is_mesh;
use crate::meshes::packages::Packages;
use crate::structure::looks::{Looks, Shape, Visual};
use crate::warning::RobotWarning;

/// Folders, from that of the URDF upwards, beside which a package is looked for.
const FOLDERS: usize = 5;
/// Prefix of the name of a file in a package.
const PACKAGE: &str = "package://";
/// Largest mesh that is used (bytes).
const LARGEST_MESH: u64 = 64 << 20;

impl Looks {
    /// Finds the files of the meshes and removes meshes without one.
    ///
    /// Outside packages a mesh must lie below the folder of the URDF, unless `folders` says otherwise.
    pub(crate) fn find_meshes(
        &mut self,
        urdf: &Path,
        packages: &Packages,
        folders: MeshFolders,
    ) -> Option<RobotWarning> {
        let folder = folder_of(urdf);
        let is_let_in = |name: &str, path: &Path| {
            folders == MeshFolders::Anywhere
                || name.starts_with(PACKAGE)
                || files::is_below(path, folder)
        };
        let mut missing = vec![];
        let mut has_file = |visual: &mut Visual| {
            let Shape::Mesh { file, .. } = &mut visual.shape else { return true };
            let name = file.to_string_lossy().into_owned();
            let all = candidates(file, urdf, packages).into_iter();
            let found = all.filter(|path| is_let_in(&name, path)).find(|path| usable(path));
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

/// Candidate paths of a file that a URDF names. Relative names start at the URDF's folder.
///
/// A package is a folder of its name that holds the URDF, lies beside it or beside a folder above
/// it, or is one of `packages`. A name in a package never leads outside the package.
fn candidates(name: &Path, urdf: &Path, packages: &Packages) -> Vec<PathBuf> {
    let name = name.to_string_lossy();
    let folder = urdf.parent().unwrap_or(Path::new(""));
    let Some(rest) = name.strip_prefix(PACKAGE) else {
        return vec![folder.join(name.strip_prefix("file://").unwrap_or(&name))];
    };
    let inside = |c: Component| matches!(c, Component::Normal(_) | Component::CurDir);
    if !Path::new(rest).components().all(inside) {
        return vec![];
    }
    let (package, file) = rest.split_once('/').unwrap_or((rest, ""));
    let known = packages.candidates(package, Path::new(file.trim_start_matches('/')));
    // An empty path has no parent: it is the working folder.
    let folder = std::path::absolute(folder).unwrap_or_else(|_| folder.to_owned());
    let near = folder.ancestors().take(FOLDERS).map(|f| f.join(rest));
    // A folder that is given by name counts before one that happens to lie near.
    let (first, then) = known.split_at(usize::from(packages.named.contains_key(package)));
    first.iter().cloned().chain(near).chain(then.iter().cloned()).collect()
}

/// The folder of a file; the working folder for an empty path.
fn folder_of(file: &Path) -> &Path {
    file.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// Whether a file is regular, small enough, and a mesh.
fn usable(path: &Path) -> bool {
    let metadata = std::fs::metadata(path);
    metadata.is_ok_and(|m| m.is_file() && m.len() <= LARGEST_MESH && is_mesh(path, m.len()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_package_is_looked_for_above_the_urdf_and_never_left() {
        let urdf = Path::new("/ws/arm_description/urdf/arm.urdf");
        let at = |name: &str| candidates(Path::new(name), urdf, &Packages::default());
        let of_package = at("package://arm_description/meshes/a.stl");
        assert!(of_package.contains(&"/ws/arm_description/meshes/a.stl".into()));
        assert_eq!(at("package://arm_description/../../etc/a.stl"), Vec::<PathBuf>::new());
        assert_eq!(at("../meshes/a.stl"), [Path::new("/ws/arm_description/urdf/../meshes/a.stl")]);
        assert_eq!(at("file:///m/a.stl"), [Path::new("/m/a.stl")]);
    }

    #[test]
    fn a_package_is_looked_for_by_name_then_near_then_on_the_ros_and_ament_paths() {
        let ros = Some("/ros/arm:/ros/more:".as_ref());
        let mut packages = Packages::from_paths(ros, Some("/opt/jazzy".as_ref()));
        let urdf = Path::new("/ws/a.urdf");
        let at =
            |packages: &Packages| candidates(Path::new("package://arm/m/a.stl"), urdf, packages);
        let near = ["/ws/arm/m/a.stl", "/arm/m/a.stl"];
        let ros = ["/ros/arm/m/a.stl", "/ros/arm/arm/m/a.stl", "/ros/more/arm/m/a.stl"];
        let ament = ["/opt/jazzy/share/arm/m/a.stl"];
        let all: Vec<PathBuf> =
            near.iter().chain(&ros).chain(&ament).map(|path| PathBuf::from(*path)).collect();
        assert_eq!(at(&packages), all);
        packages.named.insert("arm".to_owned(), "/here".into());
        assert_eq!(at(&packages)[0], Path::new("/here/m/a.stl"));
        assert_eq!(at(&packages)[1..], all);
        let outside = candidates(Path::new("package://arm/../../etc/a"), urdf, &packages);
        assert_eq!(outside, Vec::<PathBuf>::new());
    }
}
