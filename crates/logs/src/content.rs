use std::{fs::File, io::Read, path::Path};

use crate::{
    LogError,
    kind::{FIRST_BYTES, Kind, UNKNOWN},
    parquet_file,
    unpacked::unpacked,
};

/// What is in a file: itself, or what was packed.
pub(crate) fn content(path: &Path) -> Result<(Kind, File), LogError> {
    let file = File::open(path).map_err(|e| LogError::unreadable(path, &e))?;
    let mut first = Vec::new();
    (&file)
        .take(FIRST_BYTES)
        .read_to_end(&mut first)
        .map_err(|e| LogError::unreadable(path, &e))?;
    match kind(path, &first)? {
        Kind::Packed(packing) => unpacked(path, file, packing, |first| kind(path, first)),
        kind => Ok((kind, file)),
    }
}

/// The kind of a file that begins with these bytes.
fn kind(path: &Path, first: &[u8]) -> Result<Kind, LogError> {
    if first.is_empty() {
        return Err(LogError::Empty { path: path.to_owned() });
    }
    let called_parquet = path.extension().is_some_and(|e| e.eq_ignore_ascii_case("parquet"));
    Kind::of(first).map_err(|stranger| {
        if stranger == UNKNOWN && called_parquet {
            return LogError::broken(path, parquet_file::KIND, &"it does not begin with PAR1");
        }
        LogError::other_kind(path, stranger)
    })
}
