use std::path::{Path, PathBuf};

use logs::LogError;

/// A robot as two files: `robot.urdf` and `robot.toml`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct RobotFiles {
    /// Text of `robot.urdf`.
    pub urdf: String,
    /// Text of `robot.toml`, whose `urdf` is `robot.urdf`.
    pub toml: String,
}

impl RobotFiles {
    /// Writes both into a folder, each whole or not at all, and says where `robot.toml` is.
    ///
    /// # Errors
    ///
    /// [`LogError::Unwritable`].
    pub fn write(&self, folder: &Path) -> Result<PathBuf, LogError> {
        let file = |name: &str, text: &str| {
            let path = folder.join(name);
            logs::replace_file(&path, |file| {
                Ok(std::io::Write::write_all(file, text.as_bytes())?)
            })?;
            Ok(path)
        };
        file("robot.urdf", &self.urdf)?;
        file("robot.toml", &self.toml)
    }
}
