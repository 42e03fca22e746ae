use std::path::{Path, PathBuf};

use logs::{Channel, FileOverview, JointInfo, LogError, LogInfo, ReadOptions, Run};
use robot::{Actuator, Inertia, Joint, JointKind, Limits, Link, Robot};
use schemars::{JsonSchema, Schema};
use serde::Serialize;

use crate::columns::ColumnArguments;
use crate::commands::log_columns::{self, ColumnsRecord};
use crate::error::CliError;
use crate::exit_status::ExitStatus;
use crate::input::PartArguments;
use crate::output::{display_path, print, print_json, table};

/// Name and version of the schema of what `--json` prints.
const SCHEMA: &str = "plumbline.log_info/1";

/// Arguments of `log info`.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// Logs (CSV, Parquet, NumPy, MATLAB, HDF5, bags of ROS 2), one run each, and datasets of LeRobot, one
    /// run an episode
    #[arg(required = true)]
    files: Vec<PathBuf>,
    /// The robot, for names, order, types and limits of the joints
    #[arg(long)]
    robot: Option<PathBuf>,
    #[command(flatten)]
    part: PartArguments,
    #[command(flatten)]
    columns: ColumnArguments,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

/// Prints what there is to know about each log before it is used.
pub fn run(arguments: &Arguments) -> Result<ExitStatus, CliError> {
    let reader = arguments.columns.reader()?;
    let described = arguments.robot.as_deref().map(|path| arguments.part.load(path));
    let described = described.transpose()?;
    let mut runs: Vec<Run> = Vec::new();
    let mut infos = Vec::new();
    let mut selected = Vec::new();
    for path in &arguments.files {
        selected.push((path, arguments.columns.episodes_of(path)?));
    }
    let each = selected.iter().flat_map(|(path, runs)| runs.iter().map(move |e| (*path, e)));
    let mut unnamed = Vec::new();
    for (path, episode) in each {
        let robot = match &described {
            Some(loaded) => loaded.robot.clone(),
            None if arguments.part.joints.is_empty() => {
                let options = reader.options(episode);
                match robot_from_columns(path, &options) {
                    Err(error) if log_columns::is_about_names(&error) => {
                        // An episode has the columns of any other.
                        if unnamed.iter().all(|(own, _)| own != path) {
                            unnamed.push((path.clone(), logs::file_overview(path, &options)?));
                        }
                        continue;
                    }
                    found => found?,
                }
            }
            None => robot_of(&arguments.part.joints)?,
        };
        let run = reader.read(path, episode, &robot)?;
        let info = logs::log_info(&run, &robot);
        runs.push(run);
        let repeats =
            logs::duplicate_of(&runs, runs.len() - 1).map(|i| display_path(&runs[i].source));
        let of = |episode| format!("{} (episode {episode})", display_path(path));
        let path = episode.number.map_or_else(|| display_path(path), of);
        infos.push(Info { path, info, repeats });
    }
    if arguments.json {
        let files: Vec<FileInfo> = infos.iter().map(FileInfo::new).collect();
        let record = |(path, overview): &(PathBuf, FileOverview)| {
            ColumnsRecord::new(&display_path(path), overview)
        };
        let by_columns = unnamed.iter().map(record).collect();
        print_json(&Document { schema: SCHEMA, files, by_columns })?;
    } else {
        let named = infos.iter().map(text);
        let by_columns =
            unnamed.iter().map(|(path, own)| log_columns::text(&display_path(path), own));
        let blocks: Vec<String> = named.chain(by_columns).collect();
        print(&blocks.join("\n"))?;
    }
    Ok(ExitStatus::Good)
}

/// A file with what was found in it.
struct Info {
    path: String,
    info: LogInfo,
    /// The earlier file with the same samples.
    repeats: Option<String>,
}

/// A robot without limits whose joints are those of the log, to look at a log alone.
fn robot_from_columns(path: &Path, options: &ReadOptions) -> Result<Robot, CliError> {
    // The log is asked for a joint that no log has; the answer lists those it has.
    let nameless = robot_of(&["\u{0}".to_owned()])?;
    let joints = match logs::read_run(path, &nameless, options) {
        Err(LogError::JointAbsent { found, .. }) => found.into_vec(),
        Err(other) => return Err(other.into()),
        Ok(_) => Vec::new(),
    };
    if joints.is_empty() {
        return Err(CliError::NoJoints { path: path.to_owned() });
    }
    robot_of(&joints)
}

fn robot_of(joints: &[String]) -> Result<Robot, CliError> {
    let link = |(index, name): (usize, &String)| Link {
        name: name.clone(),
        parent: index.checked_sub(1),
        joint: Joint {
            name: name.clone(),
            kind: JointKind::Continuous,
            parent_from_joint: nalgebra::Isometry3::identity(),
            axis_in_joint: nalgebra::Vector3::z_axis(),
            limits: Limits::default(),
        },
        inertia: Inertia::zero(),
        actuator: Actuator::default(),
        merged: Vec::new(),
    };
    let links = joints.iter().enumerate().map(link).collect();
    Ok(Robot::new("log", nalgebra::Vector3::zeros(), links)?)
}

/// Jitter below this is none (s): clocks count nanoseconds.
const SHORTEST_S: f64 = 1e-9;

fn text(Info { path, info, repeats }: &Info) -> String {
    let gaps = match info.gaps.as_slice() {
        [] => "no gaps".to_owned(),
        gaps => {
            let longest = gaps.iter().map(|g| g.length_s).fold(0.0, f64::max);
            format!("{} gaps, the longest {} s", gaps.len(), short(longest))
        }
    };
    let jitter = if info.jitter_max_s < SHORTEST_S {
        "no jitter".to_owned()
    } else {
        let [std_ms, max_ms] = [info.jitter_std_s, info.jitter_max_s].map(|s| short(1e3 * s));
        format!("jitter {std_ms} ms, at most {max_ms} ms")
    };
    let mut text = format!(
        "{path}\n {} rows, {} s at {} Hz; {jitter}; {gaps}\n",
        info.samples,
        short(info.duration_s),
        short(info.rate_hz),
    );
    let header = ["joint", "position", "limits", ">step", "effort", ">limit", ">late", "remarks"];
    text.push_str(&table(&header, info.joints.iter().map(row)));
    text.push_str(" rad or m, N·m or N; late: velocity behind the derivative of position (ms)\n");
    let mut note = |what: &str, names: &[String]| {
        if !names.is_empty() {
            text.push_str(&format!(" {what}: {}\n", names.join(", ")));
        }
    };
    note("joints that the robot does not have", &info.unknown_joints);
    note("further columns", &info.extra);
    if let Some(unit) = suspected_unit_of_time(info) {
        text.push_str(&format!(
            "warning: time looks like {unit}: velocities are those of positions over seconds; a column map says so, \
             time = {{ column = \"...\", unit = \"{unit}\" }}\n"
        ));
    }
    if info.is_torn {
        text.push_str("warning: the last row was cut off while it was written, it is left out\n");
    }
    for mend in &info.mended {
        text.push_str(&format!("warning: {mend}\n"));
    }
    if let Some(earlier) = repeats {
        text.push_str(&format!("warning: the same samples as {earlier}\n"));
    }
    text
}

/// The unit in which the velocities of all joints that move are the derivatives of their positions, where it is not s.
fn suspected_unit_of_time(info: &LogInfo) -> Option<&'static str> {
    let mut scales = info.joints.iter().filter(|j| j.moves).filter_map(|j| j.velocity_agreement);
    let units = [(1e3, "ms"), (1e6, "us"), (1e9, "ns")];
    let of = |scale: f64| {
        let found = units.into_iter().find(|(factor, _)| (scale / factor - 1.0).abs() < 0.1);
        found.map(|(_, unit)| unit)
    };
    let unit = of(scales.next()?.scale)?;
    scales.all(|other| of(other.scale) == Some(unit)).then_some(unit)
}

fn row(joint: &JointInfo) -> Vec<String> {
    let range = |(a, b): (f64, f64)| format!("{} to {}", short(a), short(b));
    let or_none = |text: Option<String>| text.unwrap_or_else(|| "-".to_owned());
    vec![
        joint.name.clone(),
        range(joint.position),
        or_none(joint.limits.map(range)),
        or_none(joint.quantisation_step.map(|s| report::significant(s, 2))),
        range(joint.effort),
        or_none(joint.effort_limit.map(short)),
        or_none(joint.velocity_agreement.map(|a| report::significant(1e3 * a.lag_s, 2))),
        remarks(joint),
    ]
}

fn remarks(joint: &JointInfo) -> String {
    let mut remarks = Vec::new();
    if joint.suspected_degrees {
        remarks.push("degrees?".to_owned());
    }
    if !joint.moves {
        remarks.push("does not move".to_owned());
    }
    if joint.share_outside_limits > 0.0 {
        let share = report::percent(joint.share_outside_limits);
        remarks.push(format!("{share} outside its limits"));
    }
    if joint.effort_saturation > 0.01 {
        let share = report::percent(joint.effort_saturation);
        remarks.push(format!("{share} at the extreme effort"));
    }
    if let Some(agreement) = joint.velocity_agreement.filter(|a| (a.scale - 1.0).abs() > 0.02) {
        let scale = short(agreement.scale);
        remarks.push(format!("velocity is {scale} times the derivative of position"));
    }
    let missing = [Channel::Velocity, Channel::Acceleration];
    let missing = missing.into_iter().filter(|c| joint.missing.contains(c)).map(Channel::suffix);
    let missing: Vec<&str> = missing.collect();
    if !missing.is_empty() {
        remarks.push(format!("no {}", missing.join(", no ")));
    }
    remarks.join("; ")
}

fn short(value: f64) -> String {
    report::significant(value, 3)
}

/// The JSON schema of what `--json` prints.
pub fn schema() -> Schema {
    report::written_schema::<Document<'static>>(SCHEMA, "Plumbline log info")
}

/// What `--json` prints.
#[derive(Serialize, JsonSchema)]
struct Document<'a> {
    schema: &'static str,
    files: Vec<FileInfo<'a>>,
    /// Files whose columns name no joint, where no robot was given.
    by_columns: Vec<ColumnsRecord>,
}

#[derive(Serialize, JsonSchema)]
struct FileInfo<'a> {
    path: &'a str,
    samples: usize,
    is_torn: bool,
    mended: Vec<String>,
    duration_s: f64,
    rate_hz: f64,
    jitter_std_s: f64,
    jitter_max_s: f64,
    gaps: Vec<GapInfo>,
    joints: Vec<JointRecord<'a>>,
    unknown_joints: &'a [String],
    extra: &'a [String],
    repeats: Option<&'a str>,
}

#[derive(Serialize, JsonSchema)]
struct GapInfo {
    row: usize,
    start_s: f64,
    length_s: f64,
}

#[derive(Serialize, JsonSchema)]
struct JointRecord<'a> {
    name: &'a str,
    missing: Vec<&'static str>,
    position: (f64, f64),
    limits: Option<(f64, f64)>,
    share_outside_limits: f64,
    moves: bool,
    quantisation_step: Option<f64>,
    effort: (f64, f64),
    effort_limit: Option<f64>,
    effort_saturation: f64,
    suspected_degrees: bool,
    velocity_lag_s: Option<f64>,
    velocity_scale: Option<f64>,
}

impl<'a> FileInfo<'a> {
    fn new(Info { path, info, repeats }: &'a Info) -> Self {
        let gap =
            |g: &logs::TimeGap| GapInfo { row: g.row, start_s: g.start_s, length_s: g.length_s };
        Self {
            path,
            samples: info.samples,
            is_torn: info.is_torn,
            mended: info.mended.iter().map(ToString::to_string).collect(),
            duration_s: info.duration_s,
            rate_hz: info.rate_hz,
            jitter_std_s: info.jitter_std_s,
            jitter_max_s: info.jitter_max_s,
            gaps: info.gaps.iter().map(gap).collect(),
            joints: info.joints.iter().map(JointRecord::new).collect(),
            unknown_joints: &info.unknown_joints,
            extra: &info.extra,
            repeats: repeats.as_deref(),
        }
    }
}

impl<'a> JointRecord<'a> {
    fn new(joint: &'a JointInfo) -> Self {
        Self {
            name: &joint.name,
            missing: joint.missing.iter().map(|c| c.suffix()).collect(),
            position: joint.position,
            limits: joint.limits,
            share_outside_limits: joint.share_outside_limits,
            moves: joint.moves,
            quantisation_step: joint.quantisation_step,
            effort: joint.effort,
            effort_limit: joint.effort_limit,
            effort_saturation: joint.effort_saturation,
            suspected_degrees: joint.suspected_degrees,
            velocity_lag_s: joint.velocity_agreement.map(|a| a.lag_s),
            velocity_scale: joint.velocity_agreement.map(|a| a.scale),
        }
    }
}
