use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

use crate::description::Description;
use crate::urdf::{self, UrdfModel};
use crate::{ControlSettings, Looks, Robot, RobotError, RobotWarning};

/// Largest description that is read (bytes). Without its meshes, a URDF has some 100 kB.
const LARGEST_FILE: u64 = 64 << 20;

/// A robot as its files describe it.
#[derive(Debug, Clone, PartialEq)]
pub struct Loaded {
    /// The robot, with everything that `robot.toml` says.
    pub robot: Robot,
    /// The robot as the URDF alone describes it.
    pub robot_in_urdf: Robot,
    /// What the robot looks like, as the URDF says.
    pub looks: Looks,
    /// The URDF that was read.
    pub urdf_path: PathBuf,
    /// Name of the link that does not move; its frame is the base frame.
    pub base_link: String,
    /// Names of the links fixed to the base; they have no part in the dynamics.
    pub fixed_to_base: Vec<String>,
    /// How the real robot is controlled; nothing is known without a `robot.toml`.
    pub control: ControlSettings,
    /// What the owner of the files should know.
    pub warnings: Vec<RobotWarning>,
}

impl Robot {
    /// The robot described by `path`, a `robot.urdf` or a `robot.toml`.
    ///
    /// The extension decides which of the two it is; with another extension, a
    /// first character `<` makes it a URDF. A `robot.toml` beside a URDF is read
    /// only when it is named.
    ///
    /// # Errors
    ///
    /// [`RobotError::Unreadable`], or [`RobotError::InFile`] around what is wrong
    /// with the URDF or the `robot.toml`.
    pub fn load(path: &Path) -> Result<Loaded, RobotError> {
        let text = read(path)?;
        let is_toml = match path.extension().and_then(|e| e.to_str()) {
            Some("toml") => true,
            Some("urdf" | "xml") => false,
            _ => !text.trim_start().starts_with('<'),
        };
        if !is_toml {
            let model = urdf::parse(&text).map_err(|e| e.in_file(path))?;
            return Ok(Loaded::from_urdf(model, path));
        }
        let description = Description::parse(&text).map_err(|e| e.in_file(path))?;
        let urdf_path = path.parent().unwrap_or(Path::new("")).join(&description.urdf);
        let text = read(&urdf_path).map_err(|e| e.in_file(path))?;
        let model = urdf::parse(&text).map_err(|e| e.in_file(&urdf_path))?;
        let mut loaded = Loaded::from_urdf(model, &urdf_path);
        description.apply(&mut loaded).map_err(|e| e.in_file(path))?;
        Ok(loaded)
    }

    /// The robot that the text of a URDF describes, for robots that are not in a file.
    ///
    /// # Errors
    ///
    /// What is wrong with the URDF, without the name of a file.
    pub fn from_urdf(text: &str) -> Result<Self, RobotError> {
        urdf::parse(text).map(|model| model.robot)
    }
}

impl Loaded {
    fn from_urdf(mut model: UrdfModel, path: &Path) -> Self {
        model.warnings.extend(model.looks.find_meshes(path));
        let control =
            ControlSettings { gains: vec![None; model.robot.joint_count()], ..Default::default() };
        Self {
            robot_in_urdf: model.robot.clone(),
            robot: model.robot,
            looks: model.looks,
            urdf_path: path.to_owned(),
            base_link: model.base_link,
            fixed_to_base: model.fixed_to_base,
            control,
            warnings: model.warnings,
        }
    }
}

/// The text of a file, without a byte-order mark.
fn read(path: &Path) -> Result<String, RobotError> {
    let unreadable = |reason: String| RobotError::Unreadable { path: path.to_owned(), reason };
    if path.is_dir() {
        return Err(unreadable("it is a directory, a URDF or a robot.toml was expected".into()));
    }
    let file = File::open(path).map_err(|e| unreadable(reason(&e)))?;
    let mut bytes = Vec::new();
    file.take(LARGEST_FILE + 1).read_to_end(&mut bytes).map_err(|e| unreadable(reason(&e)))?;
    if bytes.len() as u64 > LARGEST_FILE {
        return Err(RobotError::TooLarge { limit: LARGEST_FILE }.in_file(path));
    }
    let text = String::from_utf8(bytes).map_err(|e| {
        let at = e.utf8_error().valid_up_to();
        unreadable(format!("byte {at} is not UTF-8, a text file was expected"))
    })?;
    let text = text.strip_prefix('\u{feff}').unwrap_or(&text);
    if text.trim().is_empty() {
        return Err(RobotError::Empty.in_file(path));
    }
    Ok(text.to_owned())
}

fn reason(error: &std::io::Error) -> String {
    if error.kind() == std::io::ErrorKind::NotFound {
        return "there is no such file, a URDF or a robot.toml was expected".to_owned();
    }
    error.to_string()
}
