//! Robots of packages that are installed for Python, by name: `menagerie:ur5e`, `description:panda_description`.
//!
//! Nothing is downloaded, and nothing of a package is run: its files are read.

mod assignments;
mod description;
mod environment;
mod menagerie;

use std::borrow::Cow;
use std::path::{Path, PathBuf};

use robot::RobotError;

use self::environment::Environment;

/// Finds the file of a robot of a package by its name.
type Find = fn(&str, &Environment) -> Result<PathBuf, String>;

/// The finder of a robot's package and the robot's name, of a path that is `PACKAGE:NAME`.
fn of_package(robot: &Path) -> Option<(Find, &str)> {
    let (package, name) = robot.to_str()?.split_once(':')?;
    match package {
        "menagerie" => Some((menagerie::file, name)),
        "description" => Some((description::file, name)),
        _ => None,
    }
}

/// Whether a path is the name of a robot of a package.
pub fn is_of_package(robot: &Path) -> bool {
    of_package(robot).is_some()
}

/// The file of a robot that is named as `PACKAGE:NAME`; any other path as it is.
///
/// # Errors
///
/// [`RobotError::Unreadable`] when the package is not installed, has no such robot, or has not downloaded it.
pub fn file_of(robot: &Path) -> Result<Cow<'_, Path>, RobotError> {
    let Some((find, name)) = of_package(robot) else {
        return Ok(Cow::Borrowed(robot));
    };
    let unreadable = |reason| RobotError::Unreadable { path: robot.to_owned(), reason };
    find(name, &Environment::of_process()).map(Cow::Owned).map_err(unreadable)
}
