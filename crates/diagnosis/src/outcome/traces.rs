use logs::LogError;
use rayon::prelude::*;
use robot::Robot;

use crate::outcome::tested_findings::TestedFindings;
use crate::search::inputs::Inputs;
use crate::signals::along::{Along, minus};

/// Signals of one run for the figures of a diagnosis, at the sample times of the regression.
#[derive(Debug, Clone, PartialEq)]
pub struct RunTraces {
    /// Name of the run.
    pub name: String,
    /// Time (s).
    pub time: Vec<f64>,
    /// One entry a joint.
    pub joints: Vec<JointTraces>,
}

/// Signals of one joint, all low-passed alike.
#[derive(Debug, Clone, PartialEq)]
pub struct JointTraces {
    /// Position (rad or m).
    pub position: Vec<f64>,
    /// Velocity (rad/s or m/s).
    pub velocity: Vec<f64>,
    /// Measured effort (N m or N).
    pub measured: Vec<f64>,
    /// Effort of the nominal model.
    pub nominal: Vec<f64>,
    /// Effort of the extended model, fitted without this run or block.
    pub extended: Vec<f64>,
}

/// The signals of every run. They include the samples in which joints stand, which no fit uses.
///
/// ```text
/// extended = effort of the robot that was found without the part + tones + clipped effort
/// ```
pub(crate) fn traces(inputs: &Inputs, tested: &TestedFindings) -> Result<Vec<RunTraces>, LogError> {
    let expected_efforts = |robot: &Robot| -> Result<Vec<Vec<Vec<f64>>>, LogError> {
        let along = inputs.log.along_all(robot, &inputs.design.frame)?;
        Ok(along.iter().map(Along::expected_effort).collect())
    };
    let about = inputs.log.along_all(inputs.robot, &inputs.design.frame)?;
    let nominal = expected_efforts(inputs.log.described.unwrap_or(inputs.robot))?;
    let found: Vec<Vec<Vec<Vec<f64>>>> = tested
        .gain
        .folds
        .par_iter()
        .map(|fitted| expected_efforts(&fitted.robot))
        .collect::<Result<_, LogError>>()?;
    let run = |(r, along): (usize, &Along)| {
        let design = &inputs.design.runs[r];
        let measured = along.measured_effort();
        let known = along.known_effort(&minus(&measured, &along.expected_effort()));
        let joint = |(j, measured): (usize, Vec<f64>)| {
            let [position, velocity, _] = design.joints[j].state.clone();
            let folds: Vec<&[f64]> = found.iter().map(|of| of[r][j].as_slice()).collect();
            let known = known[j].iter().copied().chain(std::iter::repeat(0.0));
            let extended = tested.by_run.join_folds(r, &folds);
            let extended = extended.into_iter().zip(known).map(|(x, known)| x + known).collect();
            JointTraces { position, velocity, measured, nominal: nominal[r][j].clone(), extended }
        };
        let joints = measured.into_iter().enumerate().map(joint).collect();
        RunTraces { name: design.name.clone(), time: design.time.clone(), joints }
    };
    Ok(about.iter().enumerate().map(run).collect())
}
