use logs::{LogError, PrepareSettings, Prepared, Run, centre_commands, prepare};
use robot::{Robot, TorqueSource};

/// Runs at uniform sample times. Commands stand at the times of their samples and are clipped at the joint's limit,
/// as in `diagnosis::unexplained_torque`.
pub(super) fn prepare_runs(
    robot: &Robot,
    control_rate_hz: Option<f64>,
    runs: &[Run],
    settings: &PrepareSettings,
) -> Result<Prepared, LogError> {
    for run in runs {
        let found: Vec<&str> = run.joints.iter().map(|j| j.name.as_str()).collect();
        let expected: Vec<&str> = robot.joint_names().collect();
        if found != expected {
            let to_owned_names = |names: Vec<&str>| names.into_iter().map(str::to_owned).collect();
            return Err(LogError::JointsDiffer {
                run: run.name.clone(),
                found: to_owned_names(found),
                first: robot.name().to_owned(),
                expected: to_owned_names(expected),
            });
        }
    }
    let mut prepared = prepare(runs, settings)?;
    centre_commands(robot, &mut prepared.runs, control_rate_hz);
    for run in &mut prepared.runs {
        for (link, joint) in robot.links().iter().zip(&mut run.joints) {
            let limit = link.joint.limits.effort.filter(|limit| *limit > 0.0);
            let is_command = link.actuator.torque_source != TorqueSource::Measured;
            if let Some(limit) = limit.filter(|_| is_command) {
                joint.effort.iter_mut().for_each(|e| *e = e.clamp(-limit, limit));
            }
        }
    }
    Ok(prepared)
}
