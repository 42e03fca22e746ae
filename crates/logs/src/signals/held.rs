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
/// in the log. Efforts that are computed from goals are centred where the rate of the control is known; with a described
/// hold of the goals they have means of these already, and the rest is centred.
pub fn centre_commands(robot: &Robot, runs: &mut [PreparedRun], control_rate_hz: Option<f64>) {
    for run in runs {
        let rate_hz = run.rate_hz;
        let share = |control_hz: f64| 0.5 * (rate_hz / control_hz).min(1.0);
        for (link, joint) in robot.links().iter().zip(&mut run.joints) {
            if link.actuator.torque_source != TorqueSource::Commanded {
                continue;
            }
            match &joint.goal_effort {
                None => centre(&mut joint.effort, share(control_rate_hz.unwrap_or(rate_hz))),
                Some(_) if link.actuator.goal_hold_s.is_none() => {
                    centre(&mut joint.effort, control_rate_hz.map_or(0.0, share));
                }
                Some(goal) => {
                    let add = |effort: &mut [f64], by: f64| {
                        let goal = goal.values.iter().skip(goal.lead);
                        effort.iter_mut().zip(goal).for_each(|(e, g)| *e += by * g);
                    };
                    add(&mut joint.effort, -1.0);
                    centre(&mut joint.effort, control_rate_hz.map_or(0.0, share));
                    add(&mut joint.effort, 1.0);
                }
            }
        }
    }
}

fn centre(command: &mut [f64], share: f64) {
    for k in (1..command.len()).rev() {
        command[k] += share * (command[k - 1] - command[k]);
    }
}
