use std::borrow::Cow;

use effects::Frame;
use logs::{PrepareSettings, Prepared, Run, centre_commands, duplicate_of, prepare};
use robot::Robot;

use crate::columns::design::Design;
use crate::columns::shapes::sown;
use crate::error::DiagnosisError;
use crate::oscillations::heard::Heard;
use crate::oscillations::limits::limits;
use crate::oscillations::tones::{BAND, tones};
use crate::outcome::between::between;
use crate::outcome::held_out::HeldOut;
use crate::outcome::hold::words_for_hold;
use crate::outcome::traces::{RunTraces, traces};
use crate::progress::Progress;
use crate::readiness::at_limits::at_limits;
use crate::readiness::extent::{inadequate, without_unrecorded};
use crate::readiness::inspected::inspected;
use crate::readiness::second_encoders::without_idle_encoders;
use crate::result::{Diagnosis, RunSummary};
use crate::search::study::Study;
use crate::settings::Settings;
use crate::signals::log::Log;

/// Least width of the band in which tones are looked for, in cut-offs of the motion.
const WIDE: f64 = 1.5;

/// Times that tones are listened for, where any are heard: what a search without them takes for their
/// cause hides some of them from the first.
const LISTENINGS: usize = 2;

/// A diagnosis and what goes with it.
#[derive(Debug, Clone, PartialEq)]
pub struct Outcome {
    /// The answer.
    pub diagnosis: Diagnosis,
    /// Signals behind it, for figures.
    pub traces: Vec<RunTraces>,
    /// The robot with its findings.
    pub extended: Robot,
    /// The logs as they were read, where they are wrong as they stand: a turned sign, another unit.
    pub read: Option<Vec<Run>>,
    /// The logs as they were diagnosed.
    pub prepared: Prepared,
    /// What was held out in turn, by stretches of `prepared`.
    pub held_out: Vec<HeldOut>,
}

/// Finds what `robot` gets wrong in `runs`, names it, and measures what naming it buys.
///
/// The design follows these steps; each is a module of this crate.
///
/// 1. Logs are low-passed and differentiated; effort, nominal effort and every effect's
///    columns pass the same filter.
///    Where a second encoder shows a link, what lies between it and its motor is looked for in
///    what the two encoders differ by, in the same way; no effort depends on it then.
/// 2. Residuals of a model of everything give each joint's noise and its autocorrelation
///    time; `n` samples count as `n / time`.
/// 3. Hypotheses enter by evidence, physics and held-out gain, are exchanged and dropped.
/// 4. What no one size of it explains has no name.
/// 5. The search is repeated without each held-out part, which gives the gain.
/// 6. A flexible predictor tells whether structure remains and what it follows.
///
/// The same input gives the same answer, whatever the number of threads.
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
    let (given, mut warnings) = distinct(robot, runs)?;
    let inspected = inspected(robot, &given);
    let runs = inspected.runs(&given);
    warnings.extend(inspected.warnings.iter().cloned());
    let mut prepared = prepare(runs, &PrepareSettings { cutoff_hz: settings.cutoff_hz })?;
    centre_commands(robot, &mut prepared.runs, settings.control_rate_hz);
    warnings.extend(prepared.warnings.iter().map(ToString::to_string));
    warnings.extend(without_unrecorded(robot, &mut prepared));
    warnings.extend(without_idle_encoders(robot, &mut prepared));
    warnings.extend(at_limits(robot, &prepared));
    progress.step();
    let unmoved = inadequate(robot, &prepared);
    let inadequate: Vec<Option<String>> =
        inspected.spoilt.iter().cloned().zip(unmoved).map(|(s, unmoved)| s.or(unmoved)).collect();
    let moved: Vec<bool> = inadequate.iter().map(Option::is_none).collect();
    let quiet = Log { without: &settings.without, ..Log::new(&prepared, &moved) };
    let parted = between(robot, robot, settings, (&quiet, &inadequate))?;
    let about = parted.as_ref().map_or(robot, |parted| &parted.robot);
    let quiet = Log { described: Some(robot).filter(|r| turned(r, about)), ..quiet };
    let limits = limits(about, &quiet)?;
    let quiet = Log { limits: &limits, ..quiet };
    let still = Still { nominal: robot, about, settings, log: quiet, inadequate: &inadequate };
    let (Heard { tones, ringing }, (sown, design)) = still.heard(runs)?;
    warnings.extend(ringing.iter().map(|at| words_for_ringing(robot, *at)));
    progress.step();
    let study = Study {
        nominal: robot,
        robot: &sown,
        settings,
        log: Log { tones: &tones, ..quiet },
        design: &design,
        inadequate: &inadequate,
    };
    let (mut diagnosis, traces, extended, held_out) = searched(&study, progress)?;
    diagnosis.data.runs = runs.iter().map(summary).collect();
    let rates = diagnosis.data.runs.iter().map(|run| run.rate_hz);
    let fastest_hz = rates.fold(0.0, f64::max);
    if settings.control_rate_hz.is_none() {
        warnings.extend(words_for_hold(robot, &extended, fastest_hz.recip()));
    }
    diagnosis.warnings = warnings;
    let read = inspected.read;
    if read.is_some() {
        diagnosis.data.put_right = true;
        diagnosis.verdict = diagnosis.verdict.if_so_read();
    }
    Ok(Outcome { diagnosis, traces, extended, read, prepared, held_out })
}

/// Searches, tests and reports; `data.runs` and `warnings` are left for the caller.
fn searched(
    study: &Study,
    progress: &dyn Progress,
) -> Result<(Diagnosis, Vec<RunTraces>, Robot, Vec<HeldOut>), DiagnosisError> {
    progress.stage("searching for causes", 3);
    study.with_record(|record| {
        progress.step();
        let answer = study.answer(record, progress)?;
        let diagnosis = study.report(record, &answer);
        let traces = traces(study, &answer)?;
        let held_out = study.held_out(record, &answer);
        Ok((diagnosis, traces, answer.extended, held_out))
    })?
}

/// Whether motors turn otherwise than they were described to: then efforts differ too.
fn turned(described: &Robot, about: &Robot) -> bool {
    let links = described.links().iter().zip(about.links());
    let differ = |a: f64, b: f64| a.total_cmp(&b).is_ne();
    links.map(|(d, a)| (&d.actuator, &a.actuator)).any(|(d, a)| {
        differ(d.transmission_ratio, a.transmission_ratio)
            || differ(d.encoder_offset, a.encoder_offset)
    })
}

/// The robot with the germs of effects, and the design about it.
fn tangents(robot: &Robot, log: &Log) -> Result<(Robot, Design), DiagnosisError> {
    let sown = sown(robot, log)?;
    let design = Design::new(&sown, log)?;
    Ok((sown, design))
}

/// A study before its tones are known.
struct Still<'a> {
    nominal: &'a Robot,
    /// The robot that residuals are taken about.
    about: &'a Robot,
    settings: &'a Settings,
    log: Log<'a>,
    inadequate: &'a [Option<String>],
}

impl Still<'_> {
    /// The oscillations of the logs, and the tangents about a robot that has them: what hides beneath a tone is heard
    /// once the tone is taken away.
    fn heard(&self, runs: &[Run]) -> Result<(Heard, (Robot, Design)), DiagnosisError> {
        let Self { nominal, about, settings, log: quiet, inadequate } = *self;
        let mut about_them = tangents(about, &quiet)?;
        let mut heard = Heard::default();
        for _ in 0..LISTENINGS {
            let log = Log { tones: &heard.tones, ..quiet };
            let (robot, design) = (&about_them.0, &about_them.1);
            let now = listened(&Study { nominal, robot, settings, log, design, inadequate }, runs)?;
            let is_quiet = now.tones.is_empty() && heard.tones.is_empty();
            heard = now;
            if is_quiet {
                break;
            }
            about_them = tangents(about, &Log { tones: &heard.tones, ..quiet })?;
        }
        Ok((heard, about_them))
    }
}

/// The oscillations in what a search leaves, in a band much wider than the motion's.
fn listened(study: &Study, runs: &[Run]) -> Result<Heard, DiagnosisError> {
    let (prepared, settings) = (study.log.prepared, study.settings);
    let slowest = prepared.runs.iter().map(|r| r.rate_hz).fold(f64::INFINITY, f64::min);
    let wide_hz = BAND * slowest;
    if wide_hz < WIDE * prepared.cutoff_hz {
        return Ok(Heard::default());
    }
    let extended = study.extended()?;
    let mut wide = prepare(runs, &PrepareSettings { cutoff_hz: Some(wide_hz) })?;
    let known = |name: &String| prepared.runs.iter().any(|r| r.name == *name);
    wide.runs.retain(|run| known(&run.name));
    // Twice differentiated, the counts of an encoder at the link drown what is fast: there the
    // twist that was found stands for it.
    wide.runs.iter_mut().flat_map(|run| &mut run.joints).for_each(|joint| joint.link = None);
    centre_commands(&extended, &mut wide.runs, settings.control_rate_hz);
    // What is as slow as the motion may be its, and what is faster too where it repeats.
    let motions = &study.design.motion;
    let all_differ = motions.len() >= 2 && motions.iter().enumerate().all(|(r, m)| *m == r);
    let slowest_hz = if all_differ { prepared.motion_hz } else { prepared.cutoff_hz };
    Ok(tones(
        &extended,
        &wide,
        &Frame::of_logs(&wide),
        (&study.log, slowest_hz),
        (&study.practical(), settings.open_share),
    )?)
}

fn words_for_ringing(robot: &Robot, (joint, hz): (usize, f64)) -> String {
    let name = robot.joint_names().nth(joint).unwrap_or_default();
    format!(
        "{name} oscillates in a band about {hz:.1} Hz: not one tone that something keeps up, but something that rings, such as a spring or a control loop with too much delay for its gains"
    )
}

/// The runs without those that repeat another sample by sample, and what is to be said of these.
fn distinct<'a>(
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
    Ok((logs::distinct(runs), repeats.collect()))
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
