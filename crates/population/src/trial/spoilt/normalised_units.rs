use logs::Run;
use robot::Robot;

use crate::trial::spoilt::channels::positions_and_derivatives;

/// Position in normalised units at the ends of a joint's range.
const ENDS: f64 = 100.0;

/// Range of a joint without limits (rad or m).
const RANGE: (f64, f64) = (-std::f64::consts::PI, std::f64::consts::PI);

/// Writes positions and goals in normalised units, as LeRobot does:
///
/// ```text
/// q' = 200 (q - low) / (high - low) - 100
/// ```
pub(crate) fn normalise(robot: &Robot, run: &mut Run) {
    for (joint, link) in run.joints.iter_mut().zip(robot.links()) {
        let (low, high) = link.joint.limits.position.unwrap_or(RANGE);
        let scale = 2.0 * ENDS / (high - low);
        let rows = 0..run.time.len();
        positions_and_derivatives(joint, rows).for_each(|x| *x *= scale);
        let offset = ENDS + scale * low;
        let goals = joint.desired_position.iter_mut().chain(&mut joint.link_position).flatten();
        joint.position.iter_mut().chain(goals).for_each(|q| *q -= offset);
    }
}
