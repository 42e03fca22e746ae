use logs::Run;
use robot::{Loaded, Robot};

use crate::error::PopulationError;
use crate::robot_files::RobotFiles;

/// The described robot with a torque limit of a joint that the logs exceed by a share of it:
///
/// ```text
/// limit = max |effort| / (1 + excess)
/// ```
///
/// `files` are those of `described`.
pub(crate) fn lower(
    files: &RobotFiles,
    described: &Loaded,
    runs: &[Run],
    (joint, excess): (usize, f64),
) -> Result<RobotFiles, PopulationError> {
    let mut robot: Robot = described.robot.clone();
    let efforts = runs.iter().flat_map(|run| &run.joints[joint].effort);
    let largest = efforts.fold(0.0, |most: f64, tau| most.max(tau.abs()));
    if let Some(link) = robot.link_mut(joint).filter(|_| largest > 0.0) {
        link.joint.limits.effort = Some(largest / (1.0 + excess));
    }
    Ok(RobotFiles { toml: described.to_toml(&robot, "robot.urdf")?, ..files.clone() })
}
