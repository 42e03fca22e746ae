//! Files under temporary names, and what a process that was killed has left of them.

use std::collections::BTreeSet;
use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Mutex;

use tempfile::TempPath;

/// Beginning of a temporary name; a few letters and digits follow.
const PREFIX: &str = ".plumbline-";
/// Number of these letters and digits.
const RANDOM: usize = 6;

/// The folders that this process has swept.
static SWEPT: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());

/// A new file under a temporary name, which is held for as long as the file is open: a file that nobody holds was left
/// by a process that has ended, and is removed before the first one is made in a folder.
pub(super) fn create(folder: &Path) -> io::Result<(File, TempPath)> {
    sweep_once(folder);
    loop {
        let mut builder = tempfile::Builder::new();
        // The same rights as any new file, not those of a private temporary one.
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt;
            builder.permissions(fs::Permissions::from_mode(0o666));
        }
        let file = builder.prefix(PREFIX).rand_bytes(RANDOM).tempfile_in(folder)?;
        // Where the file system knows no locks, nothing is swept.
        let _ = file.as_file().lock();
        let (file, name) = file.into_parts();
        // Another process may have swept it before it was held.
        if name.exists() {
            return Ok((file, name));
        }
    }
}

fn sweep_once(folder: &Path) {
    let is_first = SWEPT.lock().is_ok_and(|mut swept| swept.insert(folder.to_owned()));
    if is_first {
        sweep(folder);
    }
}

/// Removes the files under temporary names that nobody holds. What cannot be removed stays.
fn sweep(folder: &Path) {
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        let is_left = entry.file_name().to_str().is_some_and(is_temporary)
            && entry.file_type().is_ok_and(|kind| kind.is_file());
        let held = |path: &Path| Ok::<_, io::Error>(File::open(path)?.try_lock());
        if is_left && matches!(held(&entry.path()), Ok(Ok(()))) {
            let _ = fs::remove_file(entry.path());
        }
    }
}

fn is_temporary(name: &str) -> bool {
    name.strip_prefix(PREFIX).is_some_and(|random| {
        random.len() == RANDOM && random.bytes().all(|byte| byte.is_ascii_alphanumeric())
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_nobody_holds_is_swept_and_all_else_stays() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path();
        let (held, name) = create(path).unwrap();
        for other in
            [".plumbline-a1B2c3", ".plumbline-notes.txt", ".plumbline-", "plumbline-a1B2c3"]
        {
            fs::write(path.join(other), "").unwrap();
        }
        fs::create_dir(path.join(".plumbline-folder")).unwrap();
        sweep(path);
        assert!(!path.join(".plumbline-a1B2c3").exists());
        assert!(name.exists());
        assert_eq!(fs::read_dir(path).unwrap().count(), 5);
        drop(held);
        sweep(path);
        assert!(!name.exists());
    }

    #[test]
    fn a_folder_is_swept_before_the_first_file_is_made() {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join(".plumbline-a1B2c3"), "").unwrap();
        let made = create(folder.path()).unwrap();
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
        drop(made);
    }
}
