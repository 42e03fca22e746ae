use robot::{Loaded, Robot};

use crate::error::ExchangeError;
use crate::fate::QuantityFate;
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
    /// The fate of every quantity beyond rigid bodies.
    pub fates: Vec<QuantityFate>,
    /// The robot that the file describes, in reported positions, with approximated quantities as written.
    pub robot: Robot,
}

/// Writes the robot of `loaded` in a format, in the positions that its encoders report.
///
/// `source` is the text of its URDF. A URDF export is that text with the differences edited in; a robot without a
/// URDF gets a new one.
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
