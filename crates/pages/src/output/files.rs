use std::fs;
use std::io::Write;
use std::path::Path;

use logs::WholeFile;
use sha2::{Digest, Sha256};

use crate::output::error::ReportError;

/// SHA-256 of the bytes of a file, in hexadecimal.
///
/// # Errors
///
/// [`ReportError::Unreadable`].
pub fn sha256_of(path: &Path) -> Result<String, ReportError> {
    let mut hasher = Sha256::new();
    ::files::each_piece(path, |piece| hasher.update(piece)).map_err(|error| {
        ReportError::Unreadable { path: path.to_owned(), reason: error.to_string() }
    })?;
    Ok(hasher.finalize().iter().map(|byte| format!("{byte:02x}")).collect())
}

/// Writes files into `folder`. The folder, and the folders in the names of the files, are made where
/// they do not exist.
///
/// All of them are written under temporary names first, and renamed only when every one
/// is complete: a failure on the way leaves the folder as it was.
///
/// # Errors
///
/// [`ReportError::NotAFolder`] and [`ReportError::Unwritable`].
pub fn write_folder(folder: &Path, files: &[(&str, &[u8])]) -> Result<(), ReportError> {
    if folder.exists() && !folder.is_dir() {
        return Err(ReportError::NotAFolder { path: folder.to_owned() });
    }
    let is_new = !folder.exists();
    fs::create_dir_all(folder).map_err(|e| unwritable(folder, &e))?;
    let written = temporaries(folder, files).inspect_err(|_| {
        if is_new {
            // Only removes the folder when nothing else has been put there.
            let _ = fs::remove_dir(folder);
        }
    })?;
    for (file, (name, _)) in written.into_iter().zip(files) {
        let path = folder.join(name);
        file.finish().map_err(|e| unwritable(&path, &e))?;
    }
    Ok(())
}

/// The files under temporary names in `folder`, on the disk, and the folders that they will move to.
fn temporaries(folder: &Path, files: &[(&str, &[u8])]) -> Result<Vec<WholeFile>, ReportError> {
    let written: Result<Vec<_>, _> =
        files.iter().map(|(name, bytes)| temporary(folder, name, bytes)).collect();
    let written = written?;
    for (name, _) in files {
        let path = folder.join(name);
        let parent = path.parent().unwrap_or(folder);
        fs::create_dir_all(parent).map_err(|e| unwritable(parent, &e))?;
    }
    Ok(written)
}

fn temporary(folder: &Path, name: &str, bytes: &[u8]) -> Result<WholeFile, ReportError> {
    let path = folder.join(name);
    let refused = |e: std::io::Error| unwritable(&path, &e);
    let mut file = WholeFile::create_in(folder, &path).map_err(refused)?;
    file.write_all(bytes).and_then(|()| file.sync()).map_err(refused)?;
    Ok(file)
}

fn unwritable(path: &Path, error: &std::io::Error) -> ReportError {
    ReportError::Unwritable { path: path.to_owned(), reason: error.to_string() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sha256_agrees_with_the_published_value_for_abc() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("abc");
        fs::write(&path, b"abc").unwrap();
        // FIPS 180-2, appendix B.1.
        let expected = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
        assert_eq!(sha256_of(&path).unwrap(), expected);
    }

    #[test]
    fn a_failure_leaves_the_folder_as_it_was() {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("a"), "old").unwrap();
        let files: [(&str, &[u8]); 2] = [("a", b"new"), ("a/is/no/folder", b"x")];
        assert!(write_folder(folder.path(), &files).is_err());
        assert_eq!(fs::read_to_string(folder.path().join("a")).unwrap(), "old");
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    #[test]
    fn folders_inside_are_made() {
        let folder = tempfile::tempdir().unwrap();
        write_folder(folder.path(), &[("models/a", b"x"), ("models/b", b"y")]).unwrap();
        assert_eq!(fs::read(folder.path().join("models/b")).unwrap(), b"y");
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    #[test]
    fn a_file_in_the_place_of_the_folder_is_refused() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("taken");
        fs::write(&path, "mine").unwrap();
        let refused = write_folder(&path, &[("a", b"x")]);
        assert_eq!(refused, Err(ReportError::NotAFolder { path: path.clone() }));
        assert_eq!(fs::read_to_string(&path).unwrap(), "mine");
    }
}
