use std::path::{Path, PathBuf};

use logs::LogError;
use robot::{Loaded, Robot};

use crate::error::PopulationError;

/// A robot as two files: `robot.urdf` and `robot.toml`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct RobotFiles {
    /// Text of `robot.urdf`.
    pub urdf: String,
    /// Text of `robot.toml`, whose `urdf` is `robot.urdf`.
    pub toml: String,
}

impl RobotFiles {
    /// Reads the files of a folder. A URDF alone gets a `robot.toml` that only names it.
    pub(crate) fn read(folder: &Path) -> Option<Self> {
        let urdf = files::text(&folder.join("robot.urdf"), files::KEPT_BYTES).ok()?;
        let toml = files::text(&folder.join("robot.toml"), files::KEPT_BYTES);
        Some(Self { urdf, toml: toml.unwrap_or_else(|_| "urdf = \"robot.urdf\"\n".to_owned()) })
    }

    /// The robot that they describe.
    ///
    /// # Errors
    ///
    /// [`PopulationError::Robot`], and the errors of writing them into a temporary folder.
    pub fn load(&self) -> Result<Loaded, PopulationError> {
        let temporary = std::env::temp_dir();
        let at = PopulationError::of_folder(&temporary);
        let folder = tempfile::tempdir().map_err(at)?;
        Ok(Robot::load(&self.write(folder.path())?)?)
    }

    /// Writes both into a folder atomically and returns the path of `robot.toml`.
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
