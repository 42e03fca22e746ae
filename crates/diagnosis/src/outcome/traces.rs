use logs::LogError;
use rayon::prelude::*;
use robot::Robot;

use crate::outcome::answer::Answer;
use crate::search::study::Study;
use crate::signals::along::{Along, less};

/// Signals behind a diagnosis, for figures: one run, on the regression's clock.
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

/// The signals of every run, whole: also where joints stand, of which the fit knows nothing.
///
/// ```text
/// extended = effort of the robot that was found without the part + tones + what became no torque
/// ```
pub(crate) fn traces(study: &Study, answer: &Answer) -> Result<Vec<RunTraces>, LogError> {
    let expected = |robot: &Robot| -> Result<Vec<Vec<Vec<f64>>>, LogError> {
        let along = study.log.along_all(robot, &study.design.frame)?;
        Ok(along.iter().map(Along::expected).collect())
    };
    let about = study.log.along_all(study.robot, &study.design.frame)?;
    let nominal = expected(study.log.described.unwrap_or(study.robot))?;
    let found: Vec<Vec<Vec<Vec<f64>>>> = answer
        .gain
        .folds
        .par_iter()
        .map(|solved| expected(&solved.robot))
        .collect::<Result<_, LogError>>()?;
    let run = |(r, along): (usize, &Along)| {
        let design = &study.design.runs[r];
        let measured = along.measured()?;
        let known = along.known(&less(&measured, &along.expected()))?;
        let joint = |(j, measured): (usize, Vec<f64>)| {
            let [position, velocity, _] = design.joints[j].state.clone();
            let folds: Vec<&[f64]> = found.iter().map(|of| of[r][j].as_slice()).collect();
            let known = known[j].iter().copied().chain(std::iter::repeat(0.0));
            let extended = answer.by_run.put_together(r, &folds);
            let extended = extended.into_iter().zip(known).map(|(x, known)| x + known).collect();
            JointTraces { position, velocity, measured, nominal: nominal[r][j].clone(), extended }
        };
        let joints = measured.into_iter().enumerate().map(joint).collect();
        Ok(RunTraces { name: design.name.clone(), time: design.time.clone(), joints })
    };
    about.iter().enumerate().map(run).collect()
}
