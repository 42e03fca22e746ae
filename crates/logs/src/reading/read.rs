use std::collections::BTreeMap;
use std::path::Path;

use log_formats::{
    Columns, CountedRows, Damage, FormatError, Opened, column_names, name_of_run, open, path_of_run,
};
use robot::{Robot, TorqueSource};

use crate::{
    checks::{
        even_clock::{EvenClock, even_clock},
        turns::to_turn_of,
    },
    error::LogError,
    naming::{column_map::ColumnMap, time_name::other_time},
    reading::{
        held_values::{EffortOrigin, take_new_values},
        options::ReadOptions,
        plan::Plan,
        position_loop,
    },
    runs::{repair::Repair, run::Run},
};

/// Reads one run from a file and checks it.
///
/// Columns are matched to the robot's joints by name. The columns of a joint that is not in the robot
/// are kept in `Run::extra`, and [`crate::prepare`] warns of the joint.
/// The link position of a rotation is shifted by full turns to that of its motor.
///
/// [`Run::mended`] lists the repairs:
///
/// - Rows with an impossible sample are left out where they are few. Such a sample is a position out of reach of its
///   neighbours, or an effort or speed of a size that no joint has.
/// - Full turns by which the position of a rotation jumps are removed.
/// - Time stamps that scatter by more than a step are replaced by an even clock.
/// - Rows that repeat the values of earlier rows while the arm moves are left out, and signals that come at a slower
///   rate than the rows are taken at that rate.
///
/// A file is CSV, Parquet, NumPy (npz or npy), MATLAB (mat of version 5 or 7.3), HDF5, MCAP or SQLite, or one of these
/// packed with gzip or zstd. The first bytes of the file identify its kind.
///
/// In an npz, mat or HDF5 file an array of one dimension is a column with the name of the array, such as `tau`. An
/// array of samples x n is the columns `q[0]`, `q[1]` and so on. An array of n x samples is read the same way if only
/// its second dimension is as long as time. Fields of a MATLAB structure and arrays in an HDF5 group are named `log.q`.
/// Other arrays are left out.
///
/// A ROS 2 bag is an MCAP or SQLite file, or a folder with `metadata.yaml` and such files. The messages
/// `sensor_msgs/msg/JointState` of one topic are read, or else `control_msgs/msg/JointTrajectoryControllerState` or joint
/// states in JSON, and joints are found by the names in each message. A message without any of the robot's joints is left
/// out. Time is that of the stamps, counted from the first stamp. In errors a row is a message of the topic.
///
/// Time is the column `time` (s), or else the only one with another name of time, such as `Time`, `t` or `timestamp`.
/// Dates are counted in seconds from the first one. A file without time has the time of its rows by the map's `rate_hz`.
///
/// A path such as `run/q.mat+tau.mat+t.mat` is one run in several files that lie beside the first, row by row. Columns of a
/// file without names are called by the name of the file, `tau[0]` and so on, and what several files have must be alike in all.
///
/// In a LeRobot dataset, a folder with `meta/info.json`, each episode is a run. Its lists are the columns
/// `observation.state[0]` and so on, and also `observation.state[elbow]` where `meta/info.json` names the entries.
///
/// For a robot whose efforts are those of a position loop (`effort_source` in its `robot.toml`), efforts are computed
/// from `desired_position`, even if the log has an effort. [`ReadOptions::effort`] can select the logged one.
///
/// The last row of a CSV file may lack its newline. Such a row was torn, and is left out, if the row before it
/// ends in a number in quotes and the last one does not. A
/// [`crate::LogWriter`] that was stopped while it wrote leaves such a file. No other file loses a row.
///
/// # Errors
///
/// Every [`LogError`] that names a file: no file, an empty or broken file, a missing
/// column or joint, a field that is not a finite number, time that does not increase,
/// fewer than two rows, too many impossible samples, positions in degrees, a column map that does not fit.
pub fn read_run(path: &Path, robot: &Robot, options: &ReadOptions) -> Result<Run, LogError> {
    read(path, robot, options, &mut Damage::Refused)
}

/// Reads one run as [`read_run`] does, up to the first damage, and returns the run and the error found there.
///
/// A CSV file ends before the first row that cannot be read, and a bag before the first damaged record or page. Any
/// file ends before the first sample that is not finite or whose time does not increase. A broken file of another kind
/// is refused.
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
    if let Some(rate_hz) = map.as_ref().and_then(ColumnMap::rate_hz) {
        let counted = CountedRows { log: file, rate_hz };
        return read_open_log((path, &counted), robot, options, damage);
    }
    match other_time(&column_names(file.as_ref(), path)?, options.time()) {
        Some(time) if options.map.and_then(ColumnMap::time).is_none() => {
            let options = &ReadOptions { time: &time, ..*options };
            // Arrays are read along the axis of time.
            let file = open(path, &options.request(), options.dataset, damage)?;
            read_open_log((path, file.as_ref()), robot, options, damage)
        }
        _ => read_open_log((path, file.as_ref()), robot, options, damage),
    }
}

/// Makes a run of columns in memory, with the checks of [`read_run`]. The columns are
/// `time` (s), `<joint>.position` and `<joint>.effort`, and optionally any other column of a log.
///
/// `name` is the name of the run, and stands for the path in errors. All columns must be as long as `time`.
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
    let rate_hz = options.map.and_then(ColumnMap::rate_hz);
    let names: Vec<String> = columns.keys().cloned().collect();
    let is_mapped = options.map.and_then(ColumnMap::time).is_some();
    let other = other_time(&names, options.time()).filter(|_| !is_mapped);
    let options = &ReadOptions { time: other.as_deref().unwrap_or(options.time), ..*options };
    let of_time = columns.get(options.time()).filter(|_| rate_hz.is_none());
    let any = columns.values().next().filter(|_| rate_hz.is_some());
    let expected = of_time.or(any).map_or(0, Vec::len);
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
    let columns = Columns(columns);
    let file: Box<dyn Opened> = match rate_hz {
        Some(rate_hz) => Box::new(CountedRows { log: Box::new(columns), rate_hz }),
        None => Box::new(columns),
    };
    let log = (Path::new(name), file.as_ref());
    let run = read_open_log(log, robot, options, &mut Damage::Refused)?;
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
    plan.check(robot, &mut table, damage)?;

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
            mended.extend(plan.unwrap(sources, &time, &table, channels));
        }
        plan.check_degrees(joint, sources, &time, &table, channels)?;
        if joint.kind.is_rotation() {
            let link = channels.link_position.take();
            channels.link_position = link.map(|link| to_turn_of(&channels.position, link));
        }
    }
    let efforts = match robot
        .links()
        .iter()
        .all(|link| link.actuator.torque_source == TorqueSource::Commanded)
    {
        _ if plan.is_effort_computed => EffortOrigin::Computed,
        true => EffortOrigin::Commanded,
        false => EffortOrigin::Measured,
    };
    mended.extend(take_new_values(&mut time, &mut joints, &mut table.columns, efforts));
    if plan.is_effort_computed {
        for (link, channels) in robot.links().iter().zip(&mut joints) {
            position_loop::compute_effort(&link.actuator, &time, channels);
        }
        mended.push(Repair::FromPositionLoop);
    }
    let name = match options.episode {
        Some(episode) => format!("{}_episode_{episode}", name_of_run(path)),
        None => name_of_run(path),
    };
    let (sha256, is_torn) = (file.sha256()?, file.is_torn());
    Ok(Run {
        name,
        source: path_of_run(path),
        sha256,
        is_torn,
        mended,
        time,
        joints,
        extra: table.columns,
    })
}
