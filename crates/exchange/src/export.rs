use robot::{Loaded, Robot};

use crate::error::ExchangeError;
use crate::fate::QuantityFate;
use crate::fates::fates;
use crate::format::Format;
use crate::reported::at_reported_positions;
use crate::robot_in_file::robot_in_file;
use crate::servo::with_controllers;
use crate::{actuator, mjcf, sdf, urdf, usd};

/// A robot in another program's file.
#[derive(Debug, Clone, PartialEq)]
pub struct Export {
    /// The file; empty where the format has the law of none of the servos.
    pub text: String,
    /// The fate of every quantity beyond rigid bodies.
    pub fates: Vec<QuantityFate>,
    /// The robot that the file describes, in reported positions, with approximated quantities as written.
    pub robot: Robot,
}

/// Writes the robot of `loaded`, or its servos, in a format, in the positions that its encoders report.
///
/// `source` is the text of its URDF. A URDF export is that text with the differences edited in; a robot without a
/// URDF gets a new one. Servos are the position loops of the joints, and the gains of the controller where a joint has
/// no loop of its own.
///
/// # Errors
///
/// [`ExchangeError::Malformed`] and [`ExchangeError::JointAbsent`] where `source` is not the URDF of
/// the robot, [`ExchangeError::NoPositionLoop`] where servos are asked for and there are none,
/// [`ExchangeError::Unwritable`] where a serialiser fails.
pub fn export(loaded: &Loaded, source: &str, format: Format) -> Result<Export, ExchangeError> {
    let robot = at_reported_positions(&loaded.robot);
    if Format::ACTUATORS.contains(&format) {
        return servos(loaded, &with_controllers(loaded, &robot), format);
    }
    let text = match format {
        Format::Urdf if source.contains("<robot") => urdf::edit::edit(loaded, &robot, source)?,
        Format::Urdf => urdf::write::write(loaded, &robot),
        Format::Mjcf => mjcf::write::write(loaded, &mjcf::names::with_names(&robot)),
        Format::Sdf => sdf::write(loaded, &robot),
        _ => usd::write::write(loaded, &robot),
    };
    Ok(Export { text, fates: fates(loaded, format), robot: robot_in_file(loaded, &robot, format) })
}

/// Writes the servos of `robot`, which stands in reported positions.
fn servos(loaded: &Loaded, robot: &Robot, format: Format) -> Result<Export, ExchangeError> {
    if robot.links().iter().all(|link| link.actuator.position_loop.is_none()) {
        return Err(ExchangeError::NoPositionLoop { robot: robot.name().to_owned() });
    }
    let text = match format {
        Format::ActuatorIsaac => actuator::isaac_lab::write(loaded, robot),
        Format::ActuatorBam => actuator::bam::write(robot),
        _ => Ok(actuator::mjcf::write(&mjcf::names::with_names(robot))),
    };
    let text = text.map_err(|error| ExchangeError::Unwritable { reason: error.to_string() })?;
    let fates = actuator::fates::fates(loaded, robot, format);
    Ok(Export { text, fates, robot: robot_in_file(loaded, robot, format) })
}
