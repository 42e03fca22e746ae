use std::path::Path;

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
const PRESETS: [Preset; 11] = [
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

/// Names of the presets.
pub fn preset_names() -> Vec<&'static str> {
    let mut names: Vec<&str> = PRESETS.iter().map(|preset| preset.name).collect();
    names.dedup();
    names
}

/// Finds the preset whose columns of time, positions and efforts a file has for all joints of a robot.
///
/// With a `name` only presets of that name are tried. Where none of them fits the first one is returned, so that
/// reading reports the missing columns. Without a name only presets that identify the joints are tried, and the
/// result is `None` for a file with the usual names. Of `asked` only topic, episode and dataset are used.
///
/// # Errors
///
/// With a `name`, the errors of opening the file. In every case those of reading its column names.
pub fn recognise(
    path: &Path,
    robot: &Robot,
    name: Option<&str>,
    asked: &ReadOptions,
) -> Result<Option<Recognised>, LogError> {
    let (mut first, mut without_velocity, mut without_effort) = (None, None, None);
    for preset in PRESETS.iter().filter(|p| name.map_or(p.is_certain, |name| p.name == name)) {
        let map = ColumnMap::from_text(preset.name, preset.text)?;
        let options = ReadOptions { map: Some(&map), ..*asked };
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
    }
    Ok(without_velocity.or(without_effort).or(first.filter(|_| name.is_some())))
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
