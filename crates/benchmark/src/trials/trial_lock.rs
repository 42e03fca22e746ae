use std::fs::{self, File, TryLockError};
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use crate::error::BenchmarkError;
use crate::trial_folder::unusable;

const LOCK: &str = "lock";

/// The right of one process to make a trial. It ends with the process.
pub(crate) struct TrialLock {
    path: PathBuf,
    /// The lock is on this file.
    _file: File,
}

impl TrialLock {
    /// The lock of a task in the folder of what is being made; `None` where another process has it.
    pub(crate) fn take(work: &Path, task: usize) -> Result<Option<Self>, BenchmarkError> {
        let path = work.join(format!("{task:05}.{LOCK}"));
        let file = File::create(&path).map_err(unusable(work))?;
        match file.try_lock() {
            Ok(()) => Ok(Some(Self { path, _file: file })),
            Err(TryLockError::WouldBlock) => Ok(None),
            Err(TryLockError::Error(error)) => Err(unusable(&path)(error)),
        }
    }

    /// Removes the lock with its file.
    pub(crate) fn remove(self) -> Result<(), BenchmarkError> {
        // Whoever made the trial may have removed the file that this lock is on.
        ignore_missing(fs::remove_file(&self.path), &self.path)
    }
}

/// Folder of a trial that is being made.
pub(crate) fn trial_folder(work: &Path, task: usize) -> PathBuf {
    work.join(format!("{task:05}"))
}

/// The tasks with a lock or a folder among what is being made, in rising order.
pub(crate) fn begun(work: &Path) -> Result<Vec<usize>, BenchmarkError> {
    let entries = match fs::read_dir(work) {
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(Vec::new()),
        entries => entries.map_err(unusable(work))?,
    };
    let mut tasks = Vec::new();
    for entry in entries {
        let name = entry.map_err(unusable(work))?.file_name();
        tasks.extend(
            Path::new(&name).file_stem().and_then(|stem| stem.to_str()?.parse::<usize>().ok()),
        );
    }
    tasks.sort_unstable();
    tasks.dedup();
    Ok(tasks)
}

/// Ignores `NotFound`.
pub(crate) fn ignore_missing(
    removed: std::io::Result<()>,
    path: &Path,
) -> Result<(), BenchmarkError> {
    match removed {
        Err(error) if error.kind() != ErrorKind::NotFound => Err(unusable(path)(error)),
        _ => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_begun_is_told_by_its_lock_or_its_folder() {
        let work = tempfile::tempdir().unwrap();
        assert_eq!(begun(&work.path().join("none")).unwrap(), [0; 0]);
        fs::create_dir(trial_folder(work.path(), 7)).unwrap();
        fs::write(work.path().join("note.txt"), "").unwrap();
        let lock = TrialLock::take(work.path(), 3).unwrap().unwrap();
        assert!(TrialLock::take(work.path(), 3).unwrap().is_none());
        assert_eq!(begun(work.path()).unwrap(), [3, 7]);
        lock.remove().unwrap();
        assert_eq!(begun(work.path()).unwrap(), [7]);
    }
}
