use std::{borrow::Cow, path::Path};

use log_formats::{Damage, column_names, open};
use robot::Robot;

use crate::{
    error::LogError, naming::column_map::ColumnMap, reading::options::ReadOptions,
    runs::run::Channel,
};

/// A built-in column map with a name.
struct Preset {
    name: &'static str,
    /// Description of its columns, in words.
    words: &'static str,
    /// The map.
    text: &'static str,
    /// Whether the columns identify the joint of each signal: by name, or by a fixed order of the arm.
    is_certain: bool,
}

/// Column maps of files that other programs write. Of two maps with one name the more complete one is first.
const PRESETS: [Preset; 12] = [
    Preset {
        name: "ur",
        words: "RTDE of Universal Robots, efforts in N m",
        text: "time = \"timestamp\"\nposition = \"actual_q_{i}\"\nvelocity = \"actual_qd_{i}\"\n\
               effort = \"actual_current_as_torque_{i}\"\n",
        is_certain: true,
    },
    Preset {
        name: "ur",
        words: "RTDE of Universal Robots, efforts are currents (A): scale them in a map of your own",
        text: "time = \"timestamp\"\nposition = \"actual_q_{i}\"\nvelocity = \"actual_qd_{i}\"\n\
               effort = { column = \"actual_current_{i}\", unit = \"raw\" }\n",
        is_certain: true,
    },
    Preset {
        name: "franka",
        words: "libfranka, time in ms",
        text: "time = { column = \"time\", unit = \"ms\" }\nposition = \"q[{i}]\"\n\
               velocity = \"dq[{i}]\"\neffort = \"tau_J[{i}]\"\n",
        is_certain: true,
    },
    Preset {
        name: "plotjuggler",
        words: "PlotJuggler, joints by name",
        text: "time = \"__time\"\nposition = \"/joint_states/{joint}/position\"\n\
               velocity = \"/joint_states/{joint}/velocity\"\n\
               effort = \"/joint_states/{joint}/effort\"\n",
        is_certain: true,
    },
    Preset {
        name: "plotjuggler",
        words: "PlotJuggler, joints in the order of the robot",
        text: "time = \"__time\"\nposition = \"/joint_states/position[{i}]\"\n\
               velocity = \"/joint_states/velocity[{i}]\"\n\
               effort = \"/joint_states/effort[{i}]\"\n",
        is_certain: false,
    },
    Preset {
        name: "lerobot",
        words: "a dataset of LeRobot, joints by name, radians and N m",
        text: "time = \"timestamp\"\nposition = \"observation.state[{joint}]\"\n\
               velocity = \"observation.velocity[{joint}]\"\n\
               effort = \"observation.effort[{joint}]\"\n\
               desired_position = \"action[{joint}]\"\n",
        is_certain: true,
    },
    Preset {
        name: "lerobot",
        words: "a dataset of LeRobot, joints in the order of the robot, radians and N m",
        text: "time = \"timestamp\"\nposition = \"observation.state[{i}]\"\n\
               velocity = \"observation.velocity[{i}]\"\neffort = \"observation.effort[{i}]\"\n\
               desired_position = \"action[{i}]\"\n",
        is_certain: false,
    },
    Preset {
        name: "rostopic",
        words: "joint states of rostopic echo -p, joints by name",
        text: "time = { column = \"field.header.stamp\", unit = \"ns\" }\n\
               position = \"field.position[{joint}]\"\nvelocity = \"field.velocity[{joint}]\"\n\
               effort = \"field.effort[{joint}]\"\n",
        is_certain: true,
    },
    Preset {
        name: "numpy",
        words: "arrays q, dq and tau over time",
        text: "position = \"q[{i}]\"\nvelocity = \"dq[{i}]\"\neffort = \"tau[{i}]\"\n",
        is_certain: true,
    },
    Preset {
        name: "numpy",
        words: "arrays q, qd and tau over time",
        text: "position = \"q[{i}]\"\nvelocity = \"qd[{i}]\"\neffort = \"tau[{i}]\"\n",
        is_certain: true,
    },
    Preset {
        name: "numpy",
        words: "arrays q, qd and tau over t",
        text: "time = \"t\"\nposition = \"q[{i}]\"\nvelocity = \"qd[{i}]\"\n\
               effort = \"tau[{i}]\"\n",
        is_certain: true,
    },
    Preset {
        name: "numpy",
        words: "arrays qpos, qvel and qfrc over time",
        text: "position = \"qpos[{i}]\"\nvelocity = \"qvel[{i}]\"\neffort = \"qfrc[{i}]\"\n",
        is_certain: true,
    },
];

/// The topic of joint states in the presets of PlotJuggler.
const TOPIC: &str = "/joint_states";

impl Preset {
    /// The map, with the topic that the columns of a file are under.
    fn map(&self, names: &[String]) -> Result<ColumnMap, LogError> {
        let text = match topic(names).filter(|_| self.text.contains(TOPIC)) {
            Some(topic) => Cow::Owned(self.text.replace(TOPIC, topic)),
            None => Cow::Borrowed(self.text),
        };
        ColumnMap::from_text(self.name, &text)
    }
}

/// The only topic, such as `/arm/joint_states`, with a column `TOPIC/JOINT/position` or `TOPIC/position[0]`. Names that a
/// TOML string cannot hold as they are count as none.
fn topic(names: &[String]) -> Option<&str> {
    let mut topics = names.iter().filter_map(|name| {
        let of_joint =
            || name.strip_suffix("/position").and_then(|own| Some(own.rsplit_once('/')?.0));
        name.strip_suffix("/position[0]").or_else(of_joint)
    });
    let first = topics.next()?;
    let is_plain =
        first.starts_with('/') && !first.contains(['"', '\\']) && !first.contains(char::is_control);
    (is_plain && topics.all(|topic| topic == first)).then_some(first)
}

/// A preset column map that matches the columns of a file.
#[derive(Debug, Clone, PartialEq)]
pub struct Recognised {
    /// Name of the preset.
    pub name: &'static str,
    /// Description of its columns, in words.
    pub words: &'static str,
    /// The map.
    pub map: ColumnMap,
}

/// A preset column map whose columns a file has, whatever the robot.
#[derive(Debug, Clone, PartialEq)]
pub struct Fitting {
    /// Name of the preset.
    pub name: &'static str,
    /// Description of its columns, in words.
    pub words: &'static str,
    /// Its columns of positions, such as `q[{i}]`.
    pub pattern: String,
    /// Number of joints.
    pub count: usize,
    /// Their names; none where columns are counted.
    pub joints: Vec<String>,
    /// Whether a file is read so without the name of the preset.
    pub is_certain: bool,
}

/// The first preset that has columns of time, positions, and efforts or goals among these; one with its velocities before
/// one without.
///
/// # Errors
///
/// [`LogError::Map`] of a preset.
pub(crate) fn fitting(names: &[String]) -> Result<Option<Fitting>, LogError> {
    let mut without_velocity = None;
    for preset in &PRESETS {
        let (map, Preset { name, words, is_certain, .. }) = (preset.map(names)?, preset);
        let pattern = |channel| map.pattern(channel);
        let others = [Channel::Effort, Channel::DesiredPosition].into_iter().filter_map(pattern);
        let others: Vec<&str> = others.collect();
        let Some(position) = pattern(Channel::Position) else { continue };
        let time = map.time().map_or("time", |time| &time.column);
        let has = |place: &str, with: &str| {
            let filled = |pattern: &str| names.contains(&pattern.replace(place, with));
            filled(position) && others.iter().any(|pattern| filled(pattern))
        };
        let mut joints = Vec::new();
        if let Some((before, behind)) = position.split_once("{joint}") {
            let own = |name: &'_ String| {
                let joint = name.strip_prefix(before)?.strip_suffix(behind)?;
                let is_name = joint.parse::<u64>().is_err() && has("{joint}", joint);
                is_name.then(|| joint.to_owned())
            };
            joints = names.iter().filter_map(own).collect();
        }
        let counted = (0..names.len()).take_while(|i| has("{i}", &i.to_string())).count();
        let count = if position.contains("{i}") { counted } else { joints.len() };
        if count > 0 && names.iter().any(|own| own == time) {
            let pattern = position.to_owned();
            let is_certain = *is_certain;
            let first = joints.first().map_or("", String::as_str);
            let has_velocity = map.pattern(Channel::Velocity).is_some_and(|pattern| {
                names.contains(&pattern.replace("{i}", "0").replace("{joint}", first))
            });
            let found = Fitting { name, words, pattern, count, joints, is_certain };
            if has_velocity {
                return Ok(Some(found));
            }
            without_velocity = without_velocity.or(Some(found));
        }
    }
    Ok(without_velocity)
}

/// Names of the presets.
pub fn preset_names() -> Vec<&'static str> {
    let mut names: Vec<&str> = PRESETS.iter().map(|preset| preset.name).collect();
    names.dedup();
    names
}

/// The presets as a table in Markdown: name, program, columns, and whether a file is read so without `--map`.
pub fn preset_table() -> String {
    let mut table =
        "| `--map` | of | columns | read so without `--map` |\n|---|---|---|---|\n".to_owned();
    for Preset { name, words, text, is_certain } in &PRESETS {
        let columns = text.trim_end().replace('\n', "<br>");
        let is_certain = if *is_certain { "yes" } else { "no: no name tells the order" };
        table.push_str(&format!("| `{name}` | {words} | {columns} | {is_certain} |\n"));
    }
    table
}

/// Finds the preset whose columns of time, positions and efforts a file has for all joints of a robot.
///
/// With a `name` only presets of that name are tried. Where none of them fits the first one is returned, so that
/// reading reports the missing columns. Without a name only presets that identify the joints are tried, and the
/// result is `None` for a file with the usual names. Of `asked` only topic, episode and dataset are used.
///
/// # Errors
///
/// With a `name`, the errors of opening the file. In every case those of reading its column names. Without a name
/// [`LogError::OtherCount`] where the file has the columns of a preset for another number of joints.
pub fn recognise(
    path: &Path,
    robot: &Robot,
    name: Option<&str>,
    asked: &ReadOptions,
) -> Result<Option<Recognised>, LogError> {
    let (mut first, mut without_velocity, mut without_effort) = (None, None, None);
    let mut columns = Vec::new();
    for preset in PRESETS.iter().filter(|p| name.map_or(p.is_certain, |name| p.name == name)) {
        let usual = preset.map(&[])?;
        let options = ReadOptions { map: Some(&usual), ..*asked };
        let file = match open(path, &options.request(), options.dataset, &mut Damage::default()) {
            Ok(file) => file,
            // Reading says the same of a file that is none.
            Err(_) if name.is_none() => return Ok(None),
            Err(error) => return Err(error.into()),
        };
        let names = column_names(file.as_ref(), path)?;
        if name.is_none() && is_usual(&names, robot) {
            return Ok(None);
        }
        let map = preset.map(&names)?;
        let whole = map.for_robot(robot)?;
        let has = |channel| has_all(&names, &whole, robot, channel);
        let has_time = names.iter().any(|n| n == options.time());
        let is_computed = robot.links().iter().all(|link| link.actuator.position_loop.is_some());
        let has_goal = has(Channel::Position) && has(Channel::DesiredPosition);
        let has_effort = has(Channel::Effort) || (is_computed && has_goal);
        let fits = has_time && has(Channel::Position) && has_effort;
        let has_velocity = has(Channel::Velocity);
        let absent = [Channel::Velocity, Channel::DesiredPosition].into_iter().filter(|c| !has(*c));
        let map = absent.fold(map, |map, channel| map.without(channel));
        let found = Recognised { name: preset.name, words: preset.words, map };
        match (fits, has_velocity) {
            (true, true) => return Ok(Some(found)),
            (true, false) => without_velocity = without_velocity.or(Some(found)),
            // Reading says that the effort is missing, and what there may be instead.
            _ if has_time && has_goal => without_effort = without_effort.or(Some(found)),
            (false, _) => first = first.or(Some(found)),
        }
        columns = names;
    }
    let found = without_velocity.or(without_effort).or(first.filter(|_| name.is_some()));
    match fitting(&columns)? {
        Some(own)
            if found.is_none()
                && own.is_certain
                && own.joints.is_empty()
                && own.count < robot.links().len() =>
        {
            Err(LogError::OtherCount {
                path: path.to_owned(),
                pattern: own.pattern.into(),
                words: own.words,
                found: own.count,
                joints: robot.joint_names().map(str::to_owned).collect(),
            })
        }
        _ => Ok(found),
    }
}

/// Whether a file has positions under their usual names.
fn is_usual(names: &[String], robot: &Robot) -> bool {
    robot.joint_names().any(|joint| names.contains(&format!("{joint}.position")))
}

fn has_all(names: &[String], map: &ColumnMap, robot: &Robot, channel: Channel) -> bool {
    robot.joint_names().all(|joint| {
        map.channel(joint, channel).is_some_and(|mapped| names.contains(&mapped.column))
    })
}
