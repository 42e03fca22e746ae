//! Robots of packages that are installed for Python, by name: `menagerie:ur5e`, `description:panda_description`.
//!
//! Nothing is downloaded, and nothing of a package is run: its files are read.

mod assignments;
mod description;
mod environment;
mod menagerie;

use std::borrow::Cow;
use std::path::Path;

use robot::RobotError;

use self::environment::Environment;

/// The file of a robot that is named as `PACKAGE:NAME`; any other path as it is.
///
/// # Errors
///
/// [`RobotError::Unreadable`] when the package is not installed, has no such robot, or has not downloaded it.
pub fn file_of(robot: &Path) -> Result<Cow<'_, Path>, RobotError> {
    let Some((package, name)) = robot.to_str().and_then(|text| text.split_once(':')) else {
        return Ok(Cow::Borrowed(robot));
    };
    let file = match package {
        "menagerie" => menagerie::file(name, &Environment::of_process()),
        "description" => description::file(name, &Environment::of_process()),
        _ => return Ok(Cow::Borrowed(robot)),
    };
    let unreadable = |reason| RobotError::Unreadable { path: robot.to_owned(), reason };
    file.map(Cow::Owned).map_err(unreadable)
}
