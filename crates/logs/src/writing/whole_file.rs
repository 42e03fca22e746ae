use std::fs::{self, File};
use std::io::{self, BufWriter, ErrorKind, Write};
use std::path::{Path, PathBuf};

use tempfile::TempPath;

use crate::writing::leftovers;

/// A file that appears under its name only when it is complete.
///
/// It is written under a temporary name in the same folder. [`WholeFile::finish`] flushes its bytes to the disk,
/// renames the file, and flushes the new name to the disk. Until then an earlier file of that name is untouched.
/// A `WholeFile` that is dropped before leaves no file; one that a killed process has left is removed when the next
/// process makes a file in the folder.
#[derive(Debug)]
pub struct WholeFile {
    path: PathBuf,
    file: BufWriter<File>,
    name: TempPath,
}

impl WholeFile {
    /// Creates the temporary file. Its folder must exist.
    ///
    /// # Errors
    ///
    /// The error of the operating system.
    pub fn create(path: &Path) -> io::Result<Self> {
        Self::create_in(folder_of(path), path)
    }

    /// Creates the temporary file in another folder on the same disk.
    ///
    /// # Errors
    ///
    /// The error of the operating system.
    pub fn create_in(folder: &Path, path: &Path) -> io::Result<Self> {
        let (file, name) = leftovers::create(folder).map_err(plain)?;
        Ok(Self { path: path.to_owned(), file: BufWriter::new(file), name })
    }

    /// Flushes the bytes written so far to the disk, still under the temporary name.
    ///
    /// # Errors
    ///
    /// The error of the operating system.
    pub fn sync(&mut self) -> io::Result<()> {
        self.file.flush()?;
        self.file.get_ref().sync_all()
    }

    /// Renames the complete file to its name.
    ///
    /// # Errors
    ///
    /// The error of the operating system.
    pub fn finish(mut self) -> io::Result<()> {
        self.sync()?;
        let name = self.name.keep().map_err(|error| plain(error.error))?;
        // By the C library, where a test can refuse it: `TempPath::persist` calls the kernel itself.
        fs::rename(&name, &self.path).inspect_err(|_| drop(fs::remove_file(&name)))?;
        sync_folder(folder_of(&self.path))
    }
}

impl Write for WholeFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.file.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

/// Flushes the names in a folder to the disk, where the operating system supports it.
///
/// # Errors
///
/// The error of a disk that refuses it.
pub fn sync_folder(folder: &Path) -> io::Result<()> {
    // A folder that cannot be opened as a file, as on Windows, has its names there in time.
    let Ok(folder) = File::open(folder) else { return Ok(()) };
    match folder.sync_all() {
        // So has a file system that knows of no such flush (fsync(2), EINVAL).
        Err(error) if matches!(error.kind(), ErrorKind::InvalidInput | ErrorKind::Unsupported) => {
            Ok(())
        }
        flushed => flushed,
    }
}

fn folder_of(path: &Path) -> &Path {
    path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// The error of the operating system, without the temporary name.
fn plain(error: io::Error) -> io::Error {
    let text = error.to_string();
    match text.split_once(" at path ") {
        Some((said, _)) => io::Error::new(error.kind(), said.to_owned()),
        None => error,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_that_is_not_finished_leaves_nothing() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a");
        fs::write(&path, "old").unwrap();
        let mut file = WholeFile::create(&path).unwrap();
        file.write_all(b"half").unwrap();
        file.sync().unwrap();
        drop(file);
        assert_eq!(fs::read_to_string(&path).unwrap(), "old");
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
        let mut file = WholeFile::create(&path).unwrap();
        file.write_all(b"new").unwrap();
        file.finish().unwrap();
        assert_eq!(fs::read_to_string(&path).unwrap(), "new");
    }

    #[test]
    fn an_error_says_nothing_of_the_temporary_name() {
        let error = WholeFile::create(Path::new("no/such/folder/a")).unwrap_err();
        assert_eq!(error.kind(), io::ErrorKind::NotFound);
        assert!(!error.to_string().contains(".plumbline"), "{error}");
    }
}
