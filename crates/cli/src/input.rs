use std::path::{Path, PathBuf};

use catalogue::EffectKind;
use diagnosis::Settings;
use logs::Run;
use report::{FileHash, Provenance, ReportError};
use robot::{LoadOptions, Loaded, MeshFolders, Packages, Robot, RobotError};

use crate::effect_name::find_effect;
use crate::installed::file_of;
use crate::invocation;
use crate::output::display_path;

/// What these options stand below in a help text.
const HEADING: &str = "Which part of the robot is meant, and its meshes";

/// Which part of a robot is meant, and where its meshes are.
#[derive(Debug, Clone, clap::Args)]
pub struct PartArguments {
    /// The joints that move, with commas between them; the others are locked at zero, or where
    /// --locked or `locked` in the robot.toml says
    #[arg(long, help_heading = HEADING, value_name = "JOINT", value_delimiter = ',')]
    pub joints: Vec<String>,
    /// Where locked joints stand (rad or m), with commas between them
    #[arg(long, help_heading = HEADING, value_name = "JOINT=POSITION", value_delimiter = ',', value_parser = lock)]
    pub locked: Vec<(String, f64)>,
    /// Folder of a package that meshes of the URDF are in; may be said again. ROS_PACKAGE_PATH and
    /// AMENT_PREFIX_PATH are looked through as well
    #[arg(long, help_heading = HEADING, value_name = "NAME=DIR", value_parser = package)]
    pub package: Vec<(String, PathBuf)>,
    /// Meshes may lie outside of the folder of the URDF and of packages
    #[arg(long, help_heading = HEADING)]
    pub allow_outside: bool,
}

impl PartArguments {
    /// The robot that a file or `PACKAGE:NAME` describes, or the part of it that is meant.
    ///
    /// # Errors
    ///
    /// Those of [`Robot::load_with`].
    pub fn load(&self, path: &Path) -> Result<Loaded, RobotError> {
        let variable = |name| std::env::var_os(name);
        let (ros, ament) = (variable("ROS_PACKAGE_PATH"), variable("AMENT_PREFIX_PATH"));
        let mut packages = Packages::from_paths(ros.as_deref(), ament.as_deref());
        packages.named.extend(self.package.iter().cloned());
        let joints = (!self.joints.is_empty()).then(|| self.joints.clone());
        let meshes = if self.allow_outside { MeshFolders::Anywhere } else { MeshFolders::Below };
        let locked = self.locked.iter().cloned().collect();
        Robot::load_with(&file_of(path)?, &LoadOptions { joints, locked, packages, meshes })
    }
}

/// The robot of a command, and the part of it that is meant.
#[derive(Debug, clap::Args)]
pub struct RobotArguments {
    /// The robot: a robot.urdf, an MJCF, or a robot.toml that names one; of installed Python packages also
    /// menagerie:ur5e (mujoco-menagerie) and description:panda_description (robot_descriptions)
    #[arg(long, value_name = "FILE")]
    pub robot: PathBuf,
    /// The part of it that is meant
    #[command(flatten)]
    pub part: PartArguments,
}

impl RobotArguments {
    /// The robot, or the part of it that is meant.
    ///
    /// # Errors
    ///
    /// Those of [`Robot::load_with`].
    pub fn load(&self) -> Result<Loaded, RobotError> {
        self.part.load(&self.robot)
    }

    /// This program, its command line, and the files that describe the robot and its logs.
    ///
    /// # Errors
    ///
    /// [`ReportError::Unreadable`].
    pub fn provenance(
        &self,
        loaded: &Loaded,
        map: Option<&Path>,
    ) -> Result<Provenance, ReportError> {
        provenance(&self.robot, loaded, map)
    }
}

/// How causes are searched.
#[derive(Debug, clap::Args)]
pub struct SearchArguments {
    /// Cut-off of the low-pass filter; chosen from the data when it is left out
    #[arg(long, value_name = "HZ", value_parser = positive, allow_negative_numbers = true)]
    pub cutoff_hz: Option<f64>,
    /// An effect that the robot is known not to have and is not looked for; may be said again
    #[arg(long, value_name = "EFFECT", value_parser = effect)]
    pub without: Vec<EffectKind>,
    /// Write the findings alone; parameters fitted beside them, without a name, are left out
    #[arg(long)]
    pub only_findings: bool,
}

impl SearchArguments {
    /// The settings of a diagnosis of this robot.
    pub fn settings(&self, loaded: &Loaded) -> Settings {
        Settings {
            cutoff_hz: self.cutoff_hz,
            control_rate_hz: loaded.control.rate_hz,
            without: self.without.clone(),
            only_findings: self.only_findings,
            ..Settings::default()
        }
    }
}

/// This program, its command line, and the files that describe the robot and its logs.
///
/// # Errors
///
/// [`ReportError::Unreadable`].
pub fn provenance(
    robot: &Path,
    loaded: &Loaded,
    map: Option<&Path>,
) -> Result<Provenance, ReportError> {
    let given = invocation::arguments().into_iter();
    let program = invocation::name();
    let command = std::iter::once(program.to_owned()).chain(without_out(given)).collect();
    Ok(Provenance { program, ..provenance_of(command, robot, loaded, map)? })
}

/// This program, a command line, and the files that describe the robot and its logs.
///
/// # Errors
///
/// [`ReportError::Unreadable`].
pub fn provenance_of(
    command: Vec<String>,
    robot: &Path,
    loaded: &Loaded,
    map: Option<&Path>,
) -> Result<Provenance, ReportError> {
    let robot = file_of(robot).map_err(|error| ReportError::Unreadable {
        path: robot.to_owned(),
        reason: error.to_string(),
    })?;
    let mut files = vec![hash("robot", &robot)?];
    if loaded.urdf_path != *robot {
        files.push(hash("urdf", &loaded.urdf_path)?);
    }
    files.extend(map.map(|map| hash("map", map)).transpose()?);
    Ok(Provenance {
        program: "plumbline",
        version: env!("CARGO_PKG_VERSION"),
        command,
        files,
        seed: None,
    })
}

/// The arguments without the folder of the output: the same input gives the same output wherever it is
/// written.
fn without_out(arguments: impl Iterator<Item = String>) -> impl Iterator<Item = String> {
    const OUT: &str = "--out";
    let mut is_folder = false;
    arguments.filter(move |argument| {
        let is_left_out = std::mem::replace(&mut is_folder, argument == OUT)
            || is_folder
            || argument.starts_with("--out=");
        !is_left_out
    })
}

/// A file that was read.
///
/// # Errors
///
/// [`ReportError::Unreadable`].
pub fn hash(role: &'static str, path: &Path) -> Result<FileHash, ReportError> {
    Ok(FileHash { role, path: display_path(path), sha256: report::sha256_of(path)? })
}

/// The files of runs, as they were when they were read.
pub fn hashes_of(runs: &[Run]) -> impl Iterator<Item = FileHash> {
    runs.iter().map(|run| FileHash {
        role: "log",
        path: display_path(&run.source),
        sha256: run.sha256.clone(),
    })
}

/// An effect of an option, by name or code.
fn effect(name: &str) -> Result<EffectKind, String> {
    find_effect(name).map_err(|error| error.to_string())
}

/// A locked joint and its position, as `panda_joint3=1.2`.
fn lock(text: &str) -> Result<(String, f64), String> {
    let expected = || "a joint and its position were expected, such as joint_3=1.2".to_owned();
    let (name, position) = text.split_once('=').ok_or_else(expected)?;
    let position: f64 = position.trim().parse().map_err(|_| expected())?;
    if name.is_empty() || !position.is_finite() {
        Err(expected())
    } else {
        Ok((name.to_owned(), position))
    }
}

/// A package of an option.
fn package(text: &str) -> Result<(String, PathBuf), String> {
    let pair = text.split_once('=').filter(|(name, folder)| !name.is_empty() && !folder.is_empty());
    let (name, folder) = pair.ok_or("NAME=DIR was expected")?;
    Ok((name.to_owned(), PathBuf::from(folder)))
}

/// A positive number of an option.
pub fn positive(text: &str) -> Result<f64, String> {
    number(text, |v| v > 0.0 && v.is_finite(), "a positive number was expected")
}

/// A time of an option, counted from a beginning (s).
pub fn seconds(text: &str) -> Result<f64, String> {
    number(text, |v| v >= 0.0 && v.is_finite(), "a number of seconds, 0 or more, was expected")
}

fn number(text: &str, fits: impl Fn(f64) -> bool, expected: &str) -> Result<f64, String> {
    text.parse().ok().filter(|&v| fits(v)).ok_or_else(|| expected.to_owned())
}
