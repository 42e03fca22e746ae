use std::{io::Read, path::Path};

use sha2::{Digest, Sha256};

use crate::common::error::FormatError;

/// SHA-256 of files one after the other, in hexadecimal.
pub(crate) fn sha256_of_files<'a>(
    files: impl IntoIterator<Item = &'a Path>,
) -> Result<String, FormatError> {
    let mut hasher = Sha256::new();
    let mut buffer = vec![0; 1 << 16];
    for path in files {
        let mut file = files::open(path).map_err(|e| FormatError::unreadable(path, &e))?;
        loop {
            match file.read(&mut buffer).map_err(|e| FormatError::unreadable(path, &e))? {
                0 => break,
                count => hasher.update(&buffer[..count]),
            }
        }
    }
    Ok(hexadecimal(hasher))
}

pub(crate) fn hexadecimal(hasher: Sha256) -> String {
    hasher.finalize().iter().map(|byte| format!("{byte:02x}")).collect()
}
