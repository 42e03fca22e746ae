use std::borrow::Cow;

use logs::{
    PrepareSettings, Prepared, Run, centre_commands, compare_clocks, duplicate_of, prepare,
};
use robot::Robot;

use crate::columns::common::Common;
use crate::error::DiagnosisError;
use crate::find_tones::{ShapedDesign, ToneSearch};
use crate::oscillations::limits::limits;
use crate::oscillations::lines::RingingBand;
use crate::outcome::held_out::HeldOutPart;
use crate::outcome::hold::{words_for_goals, words_for_hold};
use crate::outcome::second_encoder::compare_encoders;
use crate::outcome::traces::{RunTraces, traces};
use crate::progress::DiagnosisProgress;
use crate::readiness::at_limits::at_limits;
use crate::readiness::extent::{drop_runs_without_effort, inadequate};
use crate::readiness::inspected_logs::inspect_logs;
use crate::readiness::second_encoders::without_idle_encoders;
use crate::result::{Diagnosis, RunSummary};
use crate::search::inputs::Inputs;
use crate::settings::Settings;
use crate::signals::log::Log;

/// A diagnosis with the logs, robots and signals behind it.
#[derive(Debug, Clone, PartialEq)]
pub struct DiagnosisRun {
    /// Causes, sizes and verdicts.
    pub diagnosis: Diagnosis,
    /// Signals for figures.
    pub traces: Vec<RunTraces>,
    /// The robot with its findings.
    pub extended: Robot,
    /// The logs before correction, where a turned sign or another unit was corrected.
    pub read: Option<Vec<Run>>,
    /// The logs as they were diagnosed.
    pub prepared: Prepared,
    /// The parts that were held out in turn, as stretches of `prepared`.
    pub held_out: Vec<HeldOutPart>,
}

/// Finds the errors of the model of `robot` in `runs`, names their causes, and measures how much better the model
/// predicts once they are corrected.
///
/// 1. Logs are low-passed and differentiated; effort, nominal effort and the columns of every effect pass the same filter.
///    Where a second encoder shows a link, the position difference of the two encoders is diagnosed first, in the same
///    way, for effects between motor and link; these are not looked for in the efforts then.
/// 2. Residuals of a model of everything give the noise of each joint and its autocorrelation time; `n` samples count as
///    `n / time`.
/// 3. Hypotheses are added by evidence, physics and held-out gain, exchanged and removed.
/// 4. An effect whose size would have to vary over the logs is no finding.
/// 5. The search is repeated without each held-out part, which gives the gain.
/// 6. A flexible predictor tells whether structure remains, and which signals it follows.
///
/// The same input gives the same answer, whatever the number of threads.
///
/// # Errors
///
/// [`DiagnosisError`] for settings, logs or joints that cannot be used. Logs that cannot show an effect give a
/// verdict instead.
pub fn diagnose(
    robot: &Robot,
    runs: &[Run],
    settings: &Settings,
    progress: &dyn DiagnosisProgress,
) -> Result<DiagnosisRun, DiagnosisError> {
    diagnose_since(None, robot, runs, settings, progress)
}

/// The diagnosis of `runs` whose findings are changes since the logs `first` of the same robot: what both logs show is in
/// every model.
pub(crate) fn diagnose_since(
    first: Option<&Prepared>,
    robot: &Robot,
    runs: &[Run],
    settings: &Settings,
    progress: &dyn DiagnosisProgress,
) -> Result<DiagnosisRun, DiagnosisError> {
    let logs = Logs { runs, first };
    let (answer, logs) =
        with_inputs(robot, logs, settings, progress, |inputs| answer(inputs, progress))?;
    let Answer { mut diagnosis, traces, extended, held_out } = answer;
    let PreparedLogs { prepared, read, runs, mut warnings } = logs;
    diagnosis.data.runs = runs;
    let rates = diagnosis.data.runs.iter().map(|run| run.rate_hz);
    let fastest_hz = rates.fold(0.0, f64::max);
    if settings.control_rate_hz.is_none() {
        warnings.extend(words_for_hold(robot, &extended, fastest_hz.recip()));
    }
    warnings.extend(words_for_goals(robot, &extended, fastest_hz.recip()));
    diagnosis.warnings = warnings;
    if read.is_some() {
        diagnosis.data.put_right = true;
        diagnosis.verdict = diagnosis.verdict.of_corrected_logs();
    }
    Ok(DiagnosisRun { diagnosis, traces, extended, read, prepared, held_out })
}

/// Logs to diagnose.
pub(crate) struct Logs<'a> {
    pub runs: &'a [Run],
    /// Earlier logs of the same robot, where changes since these are looked for.
    pub first: Option<&'a Prepared>,
}

/// The logs behind the inputs of a search.
pub(crate) struct PreparedLogs {
    pub prepared: Prepared,
    /// See [`DiagnosisRun::read`].
    pub read: Option<Vec<Run>>,
    pub runs: Vec<RunSummary>,
    pub warnings: Vec<String>,
}

/// Prepares logs and calls `work` with the inputs of a search on them.
pub(crate) fn with_inputs<T>(
    robot: &Robot,
    Logs { runs, first }: Logs,
    settings: &Settings,
    progress: &dyn DiagnosisProgress,
    work: impl FnOnce(&Inputs) -> Result<T, DiagnosisError>,
) -> Result<(T, PreparedLogs), DiagnosisError> {
    settings.check()?;
    progress.stage("preparing the logs", 2);
    let t = &settings.thresholds;
    let (given, mut warnings) = without_repeats(robot, runs)?;
    compare_clocks(&given)?;
    let inspected = inspect_logs(robot, &given, t);
    let runs = inspected.runs(&given);
    warnings.extend(inspected.warnings.iter().cloned());
    let mut prepared = prepare(runs, &PrepareSettings { cutoff_hz: settings.cutoff_hz })?;
    centre_commands(robot, &mut prepared.runs, settings.control_rate_hz);
    warnings.extend(prepared.warnings.iter().map(ToString::to_string));
    warnings.extend(drop_runs_without_effort(robot, &mut prepared, &t.readiness));
    warnings.extend(without_idle_encoders(robot, &mut prepared, &t.readiness));
    warnings.extend(at_limits(robot, &prepared, &t.readiness));
    progress.step();
    let unmoved = inadequate(robot, &prepared, &t.readiness);
    let inadequate: Vec<Option<String>> =
        inspected.spoilt.iter().cloned().zip(unmoved).map(|(s, unmoved)| s.or(unmoved)).collect();
    let moved: Vec<bool> = inadequate.iter().map(Option::is_none).collect();
    let log = Log { without: &settings.without, ..Log::new(&prepared, &moved, t) };
    let second_encoder = compare_encoders(robot, robot, settings, &log, &inadequate)?;
    let about = second_encoder.as_ref().map_or(robot, |found| &found.robot);
    let described = Some(robot).filter(|robot| differ_in_drives(robot, about));
    let limits = limits(about, &Log { described, ..log })?;
    let log = Log { described, limits: &limits, ..log };
    let search = ToneSearch { nominal: robot, about, settings, log, inadequate: &inadequate };
    let (oscillations, mut shaped) = search.find_tones(runs)?;
    if let Some(first) = first {
        let common = common_since(first, &search, &shaped)?;
        common.into_iter().for_each(|common| shaped.design.add_common(common));
    }
    warnings.extend(oscillations.ringing.iter().map(|band| words_for_ringing(robot, band)));
    progress.step();
    let inputs = Inputs {
        nominal: robot,
        robot: &shaped.robot,
        settings,
        log: Log { tones: &oscillations.tones, ..log },
        design: &shaped.design,
        inadequate: &inadequate,
    };
    let worked = work(&inputs)?;
    let runs = runs.iter().map(summary).collect();
    let read = inspected.read;
    Ok((worked, PreparedLogs { prepared, read, runs, warnings }))
}

/// What the logs `first` say of the effects of the design about the same robot.
fn common_since(
    first: &Prepared,
    search: &ToneSearch,
    ShapedDesign { robot, design }: &ShapedDesign,
) -> Result<Option<Common>, DiagnosisError> {
    let ToneSearch { nominal, settings, log, .. } = *search;
    let inadequate = inadequate(robot, first, &settings.thresholds.readiness);
    let moved: Vec<bool> = inadequate.iter().map(Option::is_none).collect();
    let log = Log { prepared: first, moved: &moved, limits: &[], ..log };
    let design = design.along_others(robot, &log)?;
    Inputs { nominal, robot, settings, log, design: &design, inadequate: &inadequate }.common()
}

/// The answer of a search; the caller fills `data.runs` and `warnings` of the diagnosis.
struct Answer {
    diagnosis: Diagnosis,
    traces: Vec<RunTraces>,
    extended: Robot,
    held_out: Vec<HeldOutPart>,
}

/// Searches, tests and assembles the diagnosis.
fn answer(inputs: &Inputs, progress: &dyn DiagnosisProgress) -> Result<Answer, DiagnosisError> {
    progress.stage("searching for causes", 3);
    inputs.with_dataset(|dataset| {
        progress.step();
        let tested = inputs.test_findings(dataset, progress)?;
        let diagnosis = inputs.assemble(dataset, &tested);
        let traces = traces(inputs, &tested)?;
        let held_out = inputs.held_out_parts(dataset, &tested);
        Ok(Answer { diagnosis, traces, extended: tested.extended, held_out })
    })?
}

/// Whether gear ratios or encoder offsets of two robots differ, so that their efforts along a motion differ too.
fn differ_in_drives(described: &Robot, about: &Robot) -> bool {
    let links = described.links().iter().zip(about.links());
    let differ = |a: f64, b: f64| a.total_cmp(&b).is_ne();
    links.map(|(d, a)| (&d.actuator, &a.actuator)).any(|(d, a)| {
        differ(d.transmission_ratio, a.transmission_ratio)
            || differ(d.encoder_offset, a.encoder_offset)
    })
}

fn words_for_ringing(robot: &Robot, band: &RingingBand) -> String {
    let name = robot.joint_names().nth(band.joint).unwrap_or_default();
    let [low, high] = band.hz;
    format!(
        "{name} oscillates in a band from {low:.1} to {high:.1} Hz, which no single tone explains: something vibrates, such as a spring or a control loop with too much delay for its gains"
    )
}

/// The runs without exact copies of another run, and a warning for each copy.
fn without_repeats<'a>(
    robot: &Robot,
    runs: &'a [Run],
) -> Result<(Cow<'a, [Run]>, Vec<String>), DiagnosisError> {
    if runs.is_empty() {
        return Err(DiagnosisError::NoRuns);
    }
    for run in runs {
        let (got, expected) = (run.joints.len(), robot.joint_count());
        if got != expected {
            return Err(DiagnosisError::WrongJoints { run: run.name.clone(), got, expected });
        }
    }
    let repeats = runs.iter().enumerate().filter_map(|(index, run)| {
        let original = duplicate_of(runs, index)?;
        Some(format!(
            "{} repeats {} sample by sample and was left out: held-out tests would not be honest with it",
            run.name, runs[original].name
        ))
    });
    Ok((logs::without_repeats(runs), repeats.collect()))
}

fn summary(run: &Run) -> RunSummary {
    let duration_s = run.recorded_s();
    RunSummary {
        name: run.name.clone(),
        sha256: run.sha256.clone(),
        samples: run.time.len(),
        duration_s,
        rate_hz: (run.time.len().saturating_sub(1)) as f64 / duration_s,
    }
}
