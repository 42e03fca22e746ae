use std::collections::BTreeMap;
use std::path::Path;

use log_formats::{Columns, Damage, FormatError, Opened, open};
use robot::Robot;

use crate::{
    checks::{
        even_clock::{EvenClock, even_clock},
        turns::to_turn_of,
    },
    error::LogError,
    reading::{options::ReadOptions, plan::Plan, position_loop},
    runs::{repair::Repair, run::Run},
};

/// Reads one run from a file and checks it.
///
/// Columns are matched to the robot's joints by name. A joint of the log that the robot
/// does not have stays among the further columns; [`crate::prepare`] warns of it.
/// The position of a rotation's link is brought to the turn of the motor's.
///
/// [`Run::mended`] lists what was put right:
///
/// - Rows with an impossible sample are left out where they are few: a position out of reach of its neighbours, an
///   effort or speed of a size that no joint has.
/// - Full turns by which the position of a rotation jumps are taken out.
/// - Time stamps that scatter by more than a step are replaced by an even clock.
///
/// A file is CSV, Parquet, NumPy's npz or npy, MATLAB's mat of version 5 or 7.3, HDF5, MCAP or SQLite, or one of them packed
/// with gzip or zstd. The first bytes tell the kind.
///
/// Of an npz, mat or HDF5 file an array of one dimension is a column by its name, such as `tau`; one of samples
/// x n is the columns `q[0]`, `q[1]` and so on, also where it lies as n x samples and only that is
/// as long as time; fields of a structure of MATLAB and arrays in a group of HDF5 are `log.q`. Other arrays are left out.
///
/// Of a bag of ROS 2, an MCAP or SQLite file or a folder with `metadata.yaml` and such files, the messages
/// `sensor_msgs/msg/JointState` of one topic are read, joints by the names in each message; one that
/// is about none of the robot's joints is left out. Time is that of the stamps, counted from the
/// first one. In errors a row is a message of the topic.
///
/// A dataset of LeRobot, a folder with `meta/info.json`, is a run an episode; its lists are the columns
/// `observation.state[0]` and so on, and `observation.state[elbow]` where `meta/info.json` names it.
///
/// Of a robot whose efforts are those of a position loop (`effort_source` in its `robot.toml`) efforts are computed
/// from `desired_position`, whether the log holds others or not; [`ReadOptions::effort`] still asks for those.
///
/// A CSV file may lack its last newline. Its last row was torn, and is left out, when it does
/// not end in a number in quotes as the row before it does: such are the files of a
/// [`crate::LogWriter`] that was stopped while it wrote. No other file loses a row.
///
/// # Errors
///
/// Every [`LogError`] that names a file: no file, an empty or broken one, a missing
/// column or joint, a field that is not a finite number, time that does not increase,
/// fewer than two rows, many impossible samples, positions in degrees, a column map that does not fit.
pub fn read_run(path: &Path, robot: &Robot, options: &ReadOptions) -> Result<Run, LogError> {
    read(path, robot, options, &mut Damage::Refused)
}

/// Reads one run as [`read_run`] does, up to where it is damaged, and returns the error found there.
///
/// A CSV file ends before the first row that cannot be read, a bag before the first damaged record or page, and any
/// file before the first sample that is not finite or whose time does not increase. A broken file of another kind is
/// refused.
///
/// # Errors
///
/// Errors of [`read_run`] without a place in the log, and fewer than two rows before the damage.
pub fn read_run_until_damage(
    path: &Path,
    robot: &Robot,
    options: &ReadOptions,
) -> Result<(Run, Option<Box<LogError>>), LogError> {
    let mut damage = Damage::CutOff(None);
    let run = read(path, robot, options, &mut damage)?;
    let found = match damage {
        Damage::CutOff(found) => found.map(|error| Box::new(LogError::File(*error))),
        Damage::Refused => None,
    };
    Ok((run, found))
}

fn read(
    path: &Path,
    robot: &Robot,
    options: &ReadOptions,
    damage: &mut Damage,
) -> Result<Run, LogError> {
    let map = options.map.map(|map| map.for_robot(robot)).transpose()?;
    let options = &ReadOptions { map: map.as_ref(), ..*options };
    let file = open(path, &options.request(), options.dataset, damage)?;
    read_open_log((path, file.as_ref()), robot, options, damage)
}

/// The run that columns in memory hold, read and checked as [`read_run`] does it with a file:
/// `time` (s), and by joint `<joint>.position`, `<joint>.effort` and what else a log may have.
///
/// `name` stands in errors where a file would. A column of another length than `time` is an error.
///
/// # Errors
///
/// [`FormatError::ColumnLength`], and every other [`LogError`] of [`read_run`] that names a column or a row.
pub fn run_of_columns(
    name: &str,
    columns: BTreeMap<String, Vec<f64>>,
    robot: &Robot,
    options: &ReadOptions,
) -> Result<Run, LogError> {
    let expected = columns.get(options.time()).map_or(0, Vec::len);
    if let Some((column, samples)) = columns.iter().find(|(_, x)| x.len() != expected) {
        let error = FormatError::ColumnLength {
            path: name.into(),
            column: column.clone(),
            found: samples.len() as u64,
            time: options.time().to_owned(),
            expected: expected as u64,
        };
        return Err(error.into());
    }
    let map = options.map.map(|map| map.for_robot(robot)).transpose()?;
    let options = &ReadOptions { map: map.as_ref(), ..*options };
    let file = Columns(columns);
    let run = read_open_log((Path::new(name), &file), robot, options, &mut Damage::Refused)?;
    // A dot in the name begins no extension.
    Ok(Run { name: name.to_owned(), ..run })
}

/// Reads the run of an open log.
fn read_open_log(
    (path, file): (&Path, &dyn Opened),
    robot: &Robot,
    options: &ReadOptions,
    damage: &mut Damage,
) -> Result<Run, LogError> {
    let plan = Plan::new(path, file, robot, options)?;
    let mut table = file.load(&plan.needed_columns(), damage)?;
    plan.check_excerpt(&table)?;
    plan.check(&mut table, damage)?;

    let mut mended = plan.leave_out_impossible(robot, &mut table)?;

    let mut time = plan.time.take(&table.columns);
    if let Some(EvenClock { time: even, step_s, largest_s }) = even_clock(&time) {
        time = even;
        mended.push(Repair::EvenClock { step_s, largest_s });
    }
    let mut joints = plan.take_channels(robot, &mut table);
    let described = robot.links().iter().map(|l| &l.joint);
    for ((joint, sources), channels) in described.zip(&plan.joints).zip(&mut joints) {
        if joint.kind.is_rotation() {
            mended.extend(plan.unwrap(sources, (&time, &table), channels));
        }
        plan.check_degrees(joint, sources, (&time, &table), channels)?;
        if joint.kind.is_rotation() {
            let link = channels.link_position.take();
            channels.link_position = link.map(|link| to_turn_of(&channels.position, link));
        }
    }
    if plan.is_effort_computed {
        for (link, channels) in robot.links().iter().zip(&mut joints) {
            let Some(gain) = link.actuator.position_loop else { continue };
            channels.effort = position_loop::effort(gain, &time, channels);
        }
        mended.push(Repair::FromPositionLoop);
    }
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    let name = match options.episode {
        Some(episode) => format!("{stem}_episode_{episode}"),
        None => stem.into_owned(),
    };
    let (sha256, is_torn) = (file.sha256()?, file.is_torn());
    Ok(Run {
        name,
        source: path.to_owned(),
        sha256,
        is_torn,
        mended,
        time,
        joints,
        extra: table.columns,
    })
}
