use std::path::{Component, Path, PathBuf};

/// A file as it is named from a folder, both of which are there.
///
/// Whole paths come back where the two share nothing or cannot be resolved.
pub fn relative_to(folder: &Path, file: &Path) -> PathBuf {
    let (Ok(from), Ok(to)) = (folder.canonicalize(), file.canonicalize()) else {
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
    }
}
