use std::path::{Path, PathBuf};

use document::{Document, KeyPath};

use crate::error::RobotError;
use crate::loaded::Loaded;
use crate::misfit::Misfit;
use crate::robot_toml::description::Description;
use crate::structure::part::JointSelection;
use crate::whole_robot::WholeRobot;

/// A parsed `robot.toml`, with the place of every value for error messages.
pub(crate) struct DescriptionFile {
    document: Document,
    description: Description,
    path: PathBuf,
}

impl DescriptionFile {
    /// Reads the text of the file at `path`.
    ///
    /// # Errors
    ///
    /// [`RobotError::InToml`] for a text that is not TOML, an unknown key or a value of another type;
    /// [`RobotError::Unreadable`] for a text that is not TOML in a file with another extension.
    pub fn parse(text: &str, path: &Path) -> Result<Self, RobotError> {
        let in_toml = |problem| RobotError::InToml { problem: Box::new(problem) };
        let is_named_so = path.extension().is_some_and(|extension| extension == "toml");
        let document = Document::from_text(&path.display().to_string(), text).map_err(|error| {
            if is_named_so { in_toml(error) } else { RobotError::neither_xml_nor_toml(path) }
        })?;
        let description = document.parse().map_err(in_toml)?;
        Ok(Self { document, description, path: path.to_owned() })
    }

    /// Path of the URDF or MJCF that it describes.
    pub fn urdf_path(&self) -> PathBuf {
        self.path.parent().unwrap_or(Path::new("")).join(&self.description.urdf)
    }

    /// An error about the URDF, shown at the key that names the URDF.
    pub fn of_urdf(&self, error: &RobotError) -> RobotError {
        Misfit::new(KeyPath::root().key("urdf"), error.to_string()).locate_in(&self.document)
    }

    /// The joints that it lets move.
    ///
    /// # Errors
    ///
    /// [`RobotError::InToml`] for a joint that does not move, a joint named twice, or an impossible position.
    pub fn part(&self, model: &WholeRobot) -> Result<JointSelection, RobotError> {
        let part = self.description.part();
        let checked = part.check(&model.robot, &model.mimics);
        checked.map_err(|misfit| misfit.locate_in(&self.document))?;
        Ok(part)
    }

    /// Applies every key to the robot, whose locked joints are already merged.
    ///
    /// # Errors
    ///
    /// [`RobotError::InToml`] for an unknown name, a number out of its range, or keys that contradict.
    pub fn apply(&self, loaded: &mut Loaded) -> Result<(), RobotError> {
        self.description.apply(loaded).map_err(|misfit| misfit.locate_in(&self.document))
    }
}
