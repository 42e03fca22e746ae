use robot::{Loaded, Robot};

use crate::error::ExchangeError;
use crate::fate::Fated;
use crate::fates::fates;
use crate::format::Format;
use crate::reported::at_reported_positions;
use crate::robot_in_file::robot_in_file;
use crate::{mjcf, sdf, urdf, usd};

/// A robot in another program's file.
#[derive(Debug, Clone, PartialEq)]
pub struct Export {
    /// The file.
    pub text: String,
    /// Every quantity that is more than a rigid body's, with what became of it.
    pub fates: Vec<Fated>,
    /// The robot that the file describes, positions as encoders report them: what is exact, and what is
    /// approximated as it is written.
    pub robot: Robot,
}

/// The robot of `loaded` in a format, positions as its encoders report them.
///
/// `source` is the text of its URDF; a URDF is that text with what differs written into it, and a new
/// one where the robot was described otherwise.
///
/// # Errors
///
/// [`ExchangeError::Malformed`] and [`ExchangeError::JointAbsent`] where `source` is not the URDF of
/// the robot.
pub fn export(loaded: &Loaded, source: &str, format: Format) -> Result<Export, ExchangeError> {
    let robot = at_reported_positions(&loaded.robot);
    let text = match format {
        Format::Urdf if source.contains("<robot") => urdf::edit::edit(loaded, &robot, source)?,
        Format::Urdf => urdf::write::write(loaded, &robot),
        Format::Mjcf => mjcf::write::write(loaded, &robot),
        Format::Sdf => sdf::write(loaded, &robot),
        Format::Isaac => usd::write::write(loaded, &robot),
    };
    Ok(Export { text, fates: fates(loaded, format), robot: robot_in_file(loaded, &robot, format) })
}
