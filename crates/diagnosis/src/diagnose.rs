use logs::{PrepareSettings, Prepared, Run, centre_commands, duplicate_of, prepare};
use robot::Robot;

use crate::design::Design;
use crate::error::DiagnosisError;
use crate::extent::inadequate;
use crate::held_out::HeldOut;
use crate::progress::Progress;
use crate::result::{Diagnosis, RunSummary};
use crate::settings::Settings;
use crate::study::Study;
use crate::traces::RunTraces;

/// A diagnosis and what goes with it.
#[derive(Debug, Clone, PartialEq)]
pub struct Outcome {
    /// The answer.
    pub diagnosis: Diagnosis,
    /// Signals behind it, for figures.
    pub traces: Vec<RunTraces>,
    /// The robot with its findings.
    pub extended: Robot,
    /// The logs as they were diagnosed.
    pub prepared: Prepared,
    /// What was held out in turn, by stretches of `prepared`; empty unless the settings ask.
    pub held_out: Vec<HeldOut>,
}

/// Finds what `robot` gets wrong in `runs`, names it, and measures what naming it buys.
///
/// The design follows these steps; each is a module of this crate.
///
/// 1. Logs are low-passed and differentiated; effort, nominal effort and every effect's
///    columns pass the same filter.
/// 2. Residuals of a model of everything give each joint's noise and its autocorrelation
///    time; `n` samples count as `n / time`.
/// 3. Hypotheses enter by evidence, physics and held-out gain, are exchanged and dropped.
/// 4. A sign-flip test over blocks gives p-values, Benjamini & Hochberg the q-values.
/// 5. The search is repeated without each held-out part, which gives the gain.
/// 6. A flexible predictor tells whether structure remains and what it follows.
///
/// The same input and seed give the same answer, whatever the number of threads.
///
/// # Errors
///
/// [`DiagnosisError`] for settings, logs or joints that cannot be used. A log that cannot
/// show an effect is no error but a verdict.
pub fn diagnose(
    robot: &Robot,
    runs: &[Run],
    settings: &Settings,
    progress: &dyn Progress,
) -> Result<Outcome, DiagnosisError> {
    settings.check()?;
    progress.stage("preparing the logs", 2);
    let (runs, mut warnings) = distinct(robot, runs)?;
    let mut prepared = prepare(&runs, &PrepareSettings { cutoff_hz: settings.cutoff_hz })?;
    centre_commands(robot, &mut prepared.runs, settings.control_rate_hz);
    warnings.extend(prepared.warnings.iter().map(ToString::to_string));
    progress.step();
    let inadequate = inadequate(robot, &prepared);
    let moved: Vec<bool> = inadequate.iter().map(Option::is_none).collect();
    let design = Design::new(robot, &prepared, &moved)?;
    progress.step();
    let study =
        Study { robot, settings, prepared: &prepared, design: &design, inadequate: &inadequate };
    let (mut diagnosis, traces, extended, held_out) = study.run(progress)?;
    diagnosis.data.runs = runs.iter().map(summary).collect();
    diagnosis.warnings = warnings;
    Ok(Outcome { diagnosis, traces, extended, prepared, held_out })
}

/// The runs without those that repeat another sample by sample.
fn distinct(robot: &Robot, runs: &[Run]) -> Result<(Vec<Run>, Vec<String>), DiagnosisError> {
    if runs.is_empty() {
        return Err(DiagnosisError::NoRuns);
    }
    let (mut kept, mut warnings): (Vec<Run>, Vec<String>) = (Vec::new(), Vec::new());
    for run in runs {
        let (got, expected) = (run.joints.len(), robot.joint_count());
        if got != expected {
            return Err(DiagnosisError::WrongJoints { run: run.name.clone(), got, expected });
        }
    }
    for (index, run) in runs.iter().enumerate() {
        match duplicate_of(runs, index) {
            Some(original) => warnings.push(format!(
                "{} repeats {} sample by sample and was left out: held-out tests would not be honest with it",
                run.name, runs[original].name
            )),
            None => kept.push(run.clone()),
        }
    }
    Ok((kept, warnings))
}

fn summary(run: &Run) -> RunSummary {
    let duration_s =
        run.time.last().copied().unwrap_or(0.0) - run.time.first().copied().unwrap_or(0.0);
    RunSummary {
        name: run.name.clone(),
        sha256: run.sha256.clone(),
        samples: run.time.len(),
        duration_s,
        rate_hz: (run.time.len().saturating_sub(1)) as f64 / duration_s,
    }
}
