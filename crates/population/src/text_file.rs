use std::path::Path;

use crate::error::PopulationError;

/// Writes a text atomically.
pub(crate) fn write_text(path: &Path, text: &str) -> Result<(), PopulationError> {
    logs::replace_file(path, |file| Ok(std::io::Write::write_all(file, text.as_bytes())?))?;
    Ok(())
}
