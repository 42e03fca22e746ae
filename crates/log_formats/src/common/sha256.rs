use std::path::Path;

use sha2::{Digest, Sha256};

use crate::common::error::FormatError;

/// SHA-256 of files one after the other, in hexadecimal.
pub(crate) fn sha256_of_files<'a>(
    paths: impl IntoIterator<Item = &'a Path>,
) -> Result<String, FormatError> {
    let mut hasher = Sha256::new();
    for path in paths {
        files::each_piece(path, |piece| hasher.update(piece))
            .map_err(|e| FormatError::unreadable(path, &e))?;
    }
    Ok(hexadecimal(hasher))
}

pub(crate) fn hexadecimal(hasher: Sha256) -> String {
    hasher.finalize().iter().map(|byte| format!("{byte:02x}")).collect()
}
