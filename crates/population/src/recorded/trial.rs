use std::path::Path;

use logs::Run;
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use robot::Robot;

use crate::corner::{Corner, Origin};
use crate::error::PopulationError;
use crate::recorded::arm::{HeldOut, RecordedArm, Used, available};
use crate::recorded::cut::{Part, length_s, part};
use crate::recorded::draw::draw;
use crate::recorded::signals::rms;
use crate::recorded::size::Measured;
use crate::recorded::transplant::AddedCause;
use crate::robot_files::RobotFiles;
use crate::sheet::{Knowledge, TruthSheet};

/// A trial of recorded logs.
#[derive(Debug, Clone, PartialEq)]
pub struct RecordedTrial {
    /// The nominal model.
    pub robot: RobotFiles,
    /// Logs given to the diagnosis.
    pub runs: Vec<Run>,
    /// Held-out logs.
    pub held_out: Vec<Run>,
    /// The known truth.
    pub sheet: TruthSheet,
}

/// Draws a trial from the recorded logs below the folder `data`. [`Origin::Recorded`] keeps the logs as they are,
/// without a known truth. [`Origin::Transplant`] adds one cause to given and held-out logs.
///
/// Arm, held-out part and cause follow from `random` and from the arms that exist. `seed` is stated in the sheet.
///
/// # Errors
///
/// [`PopulationError::OriginSimulated`], [`PopulationError::NoRecordedLogs`], [`PopulationError::NothingMoves`], and
/// errors of reading a robot or a log.
pub fn draw_recorded_trial(
    data: &Path,
    origin: Origin,
    seed: u64,
    random: &mut ChaCha8Rng,
) -> Result<RecordedTrial, PopulationError> {
    if origin == Origin::Simulated {
        return Err(PopulationError::OriginSimulated);
    }
    let arms = available(data);
    if arms.is_empty() {
        return Err(PopulationError::NoRecordedLogs { data: data.to_owned() });
    }
    let arm = &arms[random.random_range(0..arms.len())];
    let robot = arm.robot().load()?.robot;
    let (used, steps) = arm.read(&robot)?;
    let split = split(arm.held_out_recordings(), &used, random.random_range(0..arm.splits()));
    let mut trial = plain_trial(arm, &robot, &steps, split);
    trial.sheet.seed = seed;
    if origin == Origin::Transplant {
        add_transplant(&mut trial, &robot, random)?;
    }
    Ok(trial)
}

/// Number of ways to hold a part of the logs out, over all arms below the folder `data`.
pub fn count_recorded_splits(data: &Path) -> usize {
    available(data).iter().map(RecordedArm::splits).sum()
}

/// Unchanged recorded logs below the folder `data`, with the held-out part of number `number` of all that
/// [`count_recorded_splits`] counts.
///
/// # Errors
///
/// [`PopulationError::NoRecordedLogs`] where there is no such part, and errors of reading a robot or a log.
pub fn read_recorded_split(data: &Path, number: usize) -> Result<RecordedTrial, PopulationError> {
    let mut choice = number;
    for arm in available(data) {
        if choice >= arm.splits() {
            choice -= arm.splits();
            continue;
        }
        let robot = arm.robot().load()?.robot;
        let (used, steps) = arm.read(&robot)?;
        let split = split(arm.held_out_recordings(), &used, choice);
        return Ok(plain_trial(&arm, &robot, &steps, split));
    }
    Err(PopulationError::NoRecordedLogs { data: data.to_owned() })
}

/// Given and held-out logs.
struct Split<'a> {
    /// The given logs, each with the recorded log that it comes from.
    given: Vec<(&'a Used, Run)>,
    held_out: Vec<Run>,
}

/// Splits off the log or the quarter of number `choice`.
fn split(held_out: HeldOut, used: &[Used], choice: usize) -> Split<'_> {
    let mut split = Split { given: Vec::new(), held_out: Vec::new() };
    let of = |log: &Used, name: &str, quarters: std::ops::Range<usize>| {
        let name = format!("{}_{name}", log.run.name);
        part(&log.run, &name, Part::rows(&log.run, quarters))
    };
    for (number, log) in used.iter().enumerate() {
        match held_out {
            HeldOut::Log if number == choice => split.held_out.push(log.run.clone()),
            HeldOut::Log => split.given.push((log, log.run.clone())),
            HeldOut::LastQuarter => {
                split.given.push((log, of(log, "begin", 0..Part::QUARTERS - 1)));
                split.held_out.push(of(log, "end", Part::QUARTERS - 1..Part::QUARTERS));
            }
            HeldOut::Quarter => {
                for quarter in 0..Part::QUARTERS {
                    let run = of(log, &(quarter + 1).to_string(), quarter..quarter + 1);
                    if quarter == choice {
                        split.held_out.push(run);
                    } else {
                        split.given.push((log, run));
                    }
                }
            }
        }
    }
    split
}

/// A trial of unchanged logs.
fn plain_trial(arm: &RecordedArm, robot: &Robot, steps: &[f64], split: Split) -> RecordedTrial {
    let motion =
        split.given.first().map_or(crate::corner::MotionClass::Sinusoids, |(log, _)| log.motion);
    let paths: Vec<u8> = split.given.iter().map(|(log, _)| log.path).collect();
    let runs: Vec<Run> = split.given.into_iter().map(|(_, run)| run).collect();
    let length: f64 = runs.iter().map(length_s).sum();
    let steps_of_time: usize = runs.iter().map(|run| run.time.len().saturating_sub(1)).sum();
    let measured = Measured::new(robot, &runs);
    let step = measured.moving.iter().map(|&joint| steps[joint]).filter(|step| step.is_finite());
    let corner = Corner {
        origin: Origin::Recorded,
        arm: arm.name().to_owned(),
        motion,
        effort: arm.effort(),
        joints: robot.joint_count(),
        encoder_step: step.fold(0.0, f64::max),
        rate_hz: if length > 0.0 { steps_of_time as f64 / length } else { 0.0 },
        logs: runs.len(),
        length_s: length,
        repeats: paths.len() > 1 && paths.windows(2).all(|pair| pair[0] == pair[1]),
        field: Vec::new(),
        log_kinds: Vec::new(),
        goal_delay_ms: None,
    };
    let sheet = TruthSheet {
        seed: 0,
        corner,
        knowledge: Knowledge::None,
        joints: robot.joint_names().map(str::to_owned).collect(),
        torque_rms: torque_rms(&runs, robot.joint_count()),
        causes: Vec::new(),
        strangers: Vec::new(),
    };
    RecordedTrial { robot: arm.robot().clone(), runs, held_out: split.held_out, sheet }
}

/// Adds a cause to a plain trial.
fn add_transplant(
    trial: &mut RecordedTrial,
    robot: &Robot,
    random: &mut ChaCha8Rng,
) -> Result<(), PopulationError> {
    let arm = &trial.sheet.corner.arm;
    let nothing = || PopulationError::NothingMoves { arm: arm.clone() };
    let transplant = draw(robot, &trial.runs, random).ok_or_else(nothing)?;
    let strength = transplant.strength(robot, &trial.runs);
    for run in trial.runs.iter_mut().chain(&mut trial.held_out) {
        transplant.add(robot, run);
    }
    trial.sheet.corner.origin = Origin::Transplant;
    trial.sheet.knowledge = Knowledge::Added;
    trial.sheet.torque_rms = torque_rms(&trial.runs, robot.joint_count());
    match transplant.cause(robot, strength) {
        AddedCause::Named(cause) => trial.sheet.causes.push(cause),
        AddedCause::Stranger(stranger) => trial.sheet.strangers.push(stranger),
    }
    Ok(())
}

/// RMS of the effort of each joint.
fn torque_rms(runs: &[Run], joints: usize) -> Vec<f64> {
    (0..joints).map(|joint| rms(runs.iter().flat_map(|run| &run.joints[joint].effort))).collect()
}
