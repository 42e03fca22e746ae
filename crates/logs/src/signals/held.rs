use robot::{Robot, TorqueSource};

use crate::signals::prepared::PreparedRun;

/// Shifts commanded efforts to the time of their samples.
///
/// The controller computes a command from a sample and holds it for one control
/// period. The mean command around the sample is
///
/// ```text
/// effort(t_k) = (1 - s) command(t_k) + s command(t_{k-1}),   s = min(period, interval) / (2 interval)
/// ```
///
/// Without this shift the delay of half a period is taken for friction: a delay of 1 ms at 500 Hz lowers the
/// viscous friction of a joint that moves under gravity by 1.5 %. Without a control rate every command is assumed to be
/// in the log.
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
