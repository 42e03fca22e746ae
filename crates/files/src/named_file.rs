use std::fs::{self, File, Metadata};
use std::io::{self, Read};
use std::path::Path;

use crate::error::FileError;

/// Largest file that is held in memory as a whole, where its kind has no smaller limit (bytes).
pub const KEPT_BYTES: u64 = 64 << 20;

/// What [`each_piece`] holds in memory (bytes).
const PIECE_BYTES: usize = 1 << 16;

/// Opens a file of any size.
///
/// # Errors
///
/// [`FileError::Missing`], [`FileError::Folder`], [`FileError::NotRegular`] and [`FileError::Unreadable`].
pub fn open(path: &Path) -> Result<File, FileError> {
    // Opening a pipe waits for its other end: its kind is asked first.
    regular(&fs::metadata(path)?)?;
    let file = File::open(path)?;
    // What has the name may have changed in between.
    regular(&file.metadata()?)?;
    Ok(file)
}

/// The content of a file of at most `most` bytes.
///
/// # Errors
///
/// Those of [`open`], and [`FileError::TooLarge`].
pub fn bytes(path: &Path, most: u64) -> Result<Vec<u8>, FileError> {
    let file = open(path)?;
    let length = file.metadata()?.len();
    let mut bytes = Vec::new();
    if length <= most {
        // With room for the end, which is read as well.
        let room = usize::try_from(length).unwrap_or(usize::MAX).saturating_add(1);
        bytes.try_reserve_exact(room).map_err(io::Error::from)?;
        file.take(most.saturating_add(1)).read_to_end(&mut bytes)?;
    }
    // A file that grows while it is read is larger than it said.
    let length = length.max(bytes.len() as u64);
    if length > most {
        return Err(FileError::TooLarge { bytes: length, most });
    }
    Ok(bytes)
}

/// Gives the bytes of a file of any size to `take`, piece by piece.
///
/// # Errors
///
/// Those of [`open`].
pub fn each_piece(path: &Path, mut take: impl FnMut(&[u8])) -> Result<(), FileError> {
    let mut file = open(path)?;
    let mut piece = vec![0; PIECE_BYTES];
    loop {
        match read_some(&mut file, &mut piece)? {
            0 => return Ok(()),
            length => take(&piece[..length]),
        }
    }
}

/// Some bytes of a source; 0 at its end. A read that a signal interrupts is asked again.
///
/// # Errors
///
/// Those of [`Read::read`], but for interruptions.
pub fn read_some(source: &mut impl Read, piece: &mut [u8]) -> io::Result<usize> {
    loop {
        match source.read(piece) {
            Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
            ended => return ended,
        }
    }
}

/// The text in a file of at most `most` bytes.
///
/// # Errors
///
/// Those of [`bytes`], and [`FileError::NotText`].
pub fn text(path: &Path, most: u64) -> Result<String, FileError> {
    String::from_utf8(bytes(path, most)?).map_err(|error| {
        let byte = error.utf8_error().valid_up_to();
        let breaks = error.as_bytes()[..byte].iter().filter(|byte| **byte == b'\n').count();
        FileError::NotText { line: breaks + 1, byte }
    })
}

/// Whether a file lies below a folder once links are followed. A file or a folder that is missing does not.
pub fn is_below(path: &Path, folder: &Path) -> bool {
    let whole = |path: &Path| match path.as_os_str().is_empty() {
        true => fs::canonicalize("."),
        false => fs::canonicalize(path),
    };
    matches!((whole(path), whole(folder)), (Ok(path), Ok(folder)) if path.starts_with(&folder))
}

fn regular(found: &Metadata) -> Result<(), FileError> {
    match (found.is_file(), found.is_dir()) {
        (true, _) => Ok(()),
        (_, true) => Err(FileError::Folder),
        _ => Err(FileError::NotRegular),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_is_read_up_to_its_limit_and_refused_beyond() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("text");
        fs::write(&path, "12345").unwrap();
        assert_eq!(text(&path, 5).unwrap(), "12345");
        assert_eq!(text(&path, 4), Err(FileError::TooLarge { bytes: 5, most: 4 }));
        fs::write(&path, b"a\nb\xff").unwrap();
        assert_eq!(text(&path, 5), Err(FileError::NotText { line: 2, byte: 3 }));
    }

    #[test]
    fn the_pieces_of_a_file_are_all_of_it() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("bytes");
        let content: Vec<u8> = (0..3 * PIECE_BYTES + 1).map(|k| (k % 251) as u8).collect();
        fs::write(&path, &content).unwrap();
        let mut read = Vec::new();
        each_piece(&path, |piece| read.extend_from_slice(piece)).unwrap();
        assert!(read == content);
        assert_eq!(each_piece(folder.path(), |_| {}), Err(FileError::Folder));
    }

    #[test]
    fn what_is_no_regular_file_is_named_for_what_it_is() {
        let folder = tempfile::tempdir().unwrap();
        assert_eq!(text(folder.path(), 5), Err(FileError::Folder));
        assert_eq!(text(&folder.path().join("none"), 5), Err(FileError::Missing));
        if cfg!(target_os = "linux") {
            assert_eq!(text(Path::new("/dev/zero"), 5), Err(FileError::NotRegular));
        }
    }

    #[test]
    fn a_file_that_says_it_is_empty_is_read_to_its_end() {
        if cfg!(target_os = "linux") {
            assert!(!text(Path::new("/proc/self/status"), 1 << 20).unwrap().is_empty());
        }
    }

    #[cfg(unix)]
    #[test]
    fn a_link_that_leaves_the_folder_does_not_lie_below_it() {
        let folder = tempfile::tempdir().unwrap();
        let inside = folder.path().join("a");
        fs::create_dir(&inside).unwrap();
        fs::write(folder.path().join("out"), "").unwrap();
        fs::write(inside.join("in"), "").unwrap();
        std::os::unix::fs::symlink("../out", inside.join("link")).unwrap();
        assert!(is_below(&inside.join("in"), &inside));
        assert!(!is_below(&inside.join("link"), &inside));
        assert!(!is_below(&inside.join("../out"), &inside));
        assert!(!is_below(&inside.join("none"), &inside));
    }
}
