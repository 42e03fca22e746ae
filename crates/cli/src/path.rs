use std::ffi::OsStr;
use std::path::{Component, Path, PathBuf};

/// A file as it is named from a folder, which need not be there yet.
///
/// Whole paths come back where the two share nothing, and a file that is not there as it was given.
pub fn relative_to(folder: &Path, file: &Path) -> PathBuf {
    let (Some(from), Some(to)) = (whole_folder(folder), whole_file(file)) else {
        return file.to_owned();
    };
    let (from, parts): (Vec<Component>, Vec<Component>) =
        (from.components().collect(), to.components().collect());
    let shared = from.iter().zip(&parts).take_while(|(a, b)| a == b).count();
    if shared < 2 {
        return to;
    }
    let up = (shared..from.len()).map(|_| Component::ParentDir);
    up.chain(parts[shared..].iter().copied()).collect()
}

/// A file as it is named from the working folder, without detours; the whole path where it lies outside.
pub fn near(file: &Path) -> PathBuf {
    let whole = whole_file(file).unwrap_or_else(|| file.to_owned());
    let here = std::env::current_dir().and_then(|here| here.canonicalize());
    let inside = here.ok().and_then(|here| whole.strip_prefix(here).ok().map(Path::to_owned));
    inside.unwrap_or(whole)
}

/// A folder from the root, as much of it resolved as is there.
fn whole_folder(folder: &Path) -> Option<PathBuf> {
    let folder = std::path::absolute(folder).ok()?;
    let there = folder.ancestors().find(|above| above.exists())?;
    let rest = folder.strip_prefix(there).ok()?;
    Some(there.canonicalize().ok()?.join(rest))
}

/// A file from the root under its own name, which a link has as well.
fn whole_file(file: &Path) -> Option<PathBuf> {
    if !logs::is_there(file) {
        return None;
    }
    let above = file.parent().filter(|above| *above != OsStr::new(""));
    match file.file_name() {
        Some(name) => Some(above.unwrap_or_else(|| Path::new(".")).canonicalize().ok()?.join(name)),
        None => file.canonicalize().ok(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_is_named_by_the_way_to_it() {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        std::fs::create_dir_all(at("robots/mine")).unwrap();
        std::fs::write(at("arm.urdf"), "").unwrap();
        std::fs::write(at("robots/mine/arm.urdf"), "").unwrap();
        assert_eq!(relative_to(&at("robots/mine"), &at("arm.urdf")), Path::new("../../arm.urdf"));
        let beside = relative_to(&at("robots/mine"), &at("robots/mine/arm.urdf"));
        assert_eq!(beside, Path::new("arm.urdf"));
        let from_one_to_be = relative_to(&at("out/first"), &at("robots/../arm.urdf"));
        assert_eq!(from_one_to_be, Path::new("../../arm.urdf"));
        assert_eq!(relative_to(&at("out"), Path::new("gone.csv")), Path::new("gone.csv"));
    }

    #[cfg(unix)]
    #[test]
    fn a_link_keeps_its_name() {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        std::fs::write(at("4f2a"), "").unwrap();
        std::os::unix::fs::symlink(at("4f2a"), at("run.csv")).unwrap();
        assert_eq!(relative_to(&at("out"), &at("run.csv")), Path::new("../run.csv"));
    }
}
