use robot::{Robot, TorqueSource};

use crate::signals::prepared::PreparedRun;

/// Brings commanded efforts to the time of their samples.
///
/// A command that is computed from a sample is held from then on for one period of the
/// controller, so around the sample it is on the mean
///
/// ```text
/// effort(t_k) = (1 - s) command(t_k) + s command(t_{k-1}),   s = min(period, interval) / (2 interval)
/// ```
///
/// Without this, half a period of delay passes for friction: 1 ms at 500 Hz takes 1.5 % off the
/// viscous friction of a joint that moves under gravity. Without a rate every command is assumed to be in the
/// log.
pub fn centre_commands(robot: &Robot, runs: &mut [PreparedRun], control_rate_hz: Option<f64>) {
    for run in runs {
        let share = 0.5 * (run.rate_hz / control_rate_hz.unwrap_or(run.rate_hz)).min(1.0);
        for (link, joint) in robot.links().iter().zip(&mut run.joints) {
            if link.actuator.torque_source == TorqueSource::Commanded {
                for k in (1..joint.effort.len()).rev() {
                    joint.effort[k] += share * (joint.effort[k - 1] - joint.effort[k]);
                }
            }
        }
    }
}
