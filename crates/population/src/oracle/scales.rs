use robot::Robot;

use crate::oracle::motion::SeenRun;
use crate::oracle::noise::OracleNoise;
use crate::oracle::regression::effort_rms;

/// Scale of torques at each joint (N m or N): RMS of its effort, at least the deviation of its noise and a
/// thousandth of the drive's limit.
pub(crate) fn torque_scales(runs: &[SeenRun], robot: &Robot, noise: &[OracleNoise]) -> Vec<f64> {
    let joint = |(j, (link, noise)): (usize, (&robot::Link, &OracleNoise))| {
        let limit = link.joint.limits.effort.filter(|limit| limit.is_finite()).unwrap_or(0.0);
        effort_rms(runs, j).max(noise.most().sqrt()).max(1e-3 * limit).max(1e-6)
    };
    robot.links().iter().zip(noise).enumerate().map(joint).collect()
}
