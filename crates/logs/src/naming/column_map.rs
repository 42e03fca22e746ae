use std::{
    collections::BTreeMap,
    path::{Path, PathBuf},
};

use document::{Document, DocumentError, KeyPath};
use log_formats::FormatError;
use robot::Robot;
use schemars::{JsonSchema, Schema, schema_for};
use serde::Deserialize;

use crate::{
    error::LogError,
    naming::{
        map_entry::{MappedColumn, Names, Pattern},
        nearest::nearest,
        unit::Quantity,
    },
    runs::run::Channel,
};

/// Maps the names and units of a file's columns to the signals of a robot.
///
/// ```toml
/// time = { column = "t_ns", unit = "ns" }
/// joints = ["shoulder", "elbow"]               # by default the joints of the robot
/// position = "q_{i}"
/// velocity = ["dq_a", "dq_b"]
/// effort = { column = "i[0:2]", unit = "raw", scale = [0.12, 0.08] }   # N m per ampere
///
/// [joint.shoulder]
/// position = { column = "q0", unit = "deg" }
/// ```
///
/// The entry of a joint takes precedence over the pattern for all joints. A channel without an entry or a pattern is
/// read from the column with its usual name.
#[derive(Debug, Clone)]
pub struct ColumnMap {
    path: PathBuf,
    document: Document,
    time: Option<MappedColumn>,
    rate_hz: Option<f64>,
    joints: Option<Vec<String>>,
    patterns: Vec<(Channel, Pattern)>,
    joint: BTreeMap<String, BTreeMap<Channel, MappedColumn>>,
}

/// Two maps are equal when their entries are equal.
impl PartialEq for ColumnMap {
    fn eq(&self, other: &Self) -> bool {
        (&self.path, &self.time, self.rate_hz, &self.joints, &self.patterns, &self.joint)
            == (
                &other.path,
                &other.time,
                other.rate_hz,
                &other.joints,
                &other.patterns,
                &other.joint,
            )
    }
}

/// Which columns of a file hold the signals of a robot, and in which units: what `--map` takes.
///
/// A pattern names a column for each joint, in the order of the robot or of `joints`. In it `{i}` counts joints from 0, `{n}`
/// from 1, and `{joint}` is the name of the joint; `q[2:8]` is `q[2]` to `q[7]`, and `q[:]` all from `q[0]` on. A list names
/// the columns one by one. A signal is
///
/// `signal = scale * value in SI units and radians + offset`
///
/// A channel that is not in the map is read from the column with its usual name.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "Plumbline column map")]
struct MapFile {
    /// Time of the rows; by default the column that is usual in the format.
    time: Option<MappedColumn>,
    /// Rows per second (Hz), for a file without time: row `k`, counted from 0, has the time `k / rate_hz`.
    rate_hz: Option<f64>,
    /// Names of the joints, in the order of patterns and lists; by default the joints of the robot.
    joints: Option<Vec<String>>,
    /// Position of all joints.
    position: Option<Pattern>,
    /// Velocity of all joints.
    velocity: Option<Pattern>,
    /// Acceleration of all joints.
    acceleration: Option<Pattern>,
    /// Torque or force of all joints.
    effort: Option<Pattern>,
    /// Position that the controller follows, of all joints.
    desired_position: Option<Pattern>,
    /// Velocity that the controller follows, of all joints.
    desired_velocity: Option<Pattern>,
    /// Acceleration that the controller follows, of all joints.
    desired_acceleration: Option<Pattern>,
    /// Torque or force that was commanded, of all joints.
    commanded_effort: Option<Pattern>,
    /// Position of a second encoder, behind the transmission, of all joints.
    link_position: Option<Pattern>,
    /// Columns of one joint, by its name; they take precedence over those of all joints.
    #[serde(default)]
    joint: BTreeMap<String, JointMap>,
}

/// The columns of one joint.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct JointMap {
    /// Position.
    position: Option<MappedColumn>,
    /// Velocity.
    velocity: Option<MappedColumn>,
    /// Acceleration.
    acceleration: Option<MappedColumn>,
    /// Torque or force.
    effort: Option<MappedColumn>,
    /// Position that the controller follows.
    desired_position: Option<MappedColumn>,
    /// Velocity that the controller follows.
    desired_velocity: Option<MappedColumn>,
    /// Acceleration that the controller follows.
    desired_acceleration: Option<MappedColumn>,
    /// Torque or force that was commanded.
    commanded_effort: Option<MappedColumn>,
    /// Position of a second encoder, behind the transmission.
    link_position: Option<MappedColumn>,
}

/// The entries that are present, by channel.
macro_rules! by_channel {
    ($file:expr) => {
        [
            (Channel::Position, $file.position),
            (Channel::Velocity, $file.velocity),
            (Channel::Acceleration, $file.acceleration),
            (Channel::Effort, $file.effort),
            (Channel::DesiredPosition, $file.desired_position),
            (Channel::DesiredVelocity, $file.desired_velocity),
            (Channel::DesiredAcceleration, $file.desired_acceleration),
            (Channel::CommandedEffort, $file.commanded_effort),
            (Channel::LinkPosition, $file.link_position),
        ]
        .into_iter()
        .filter_map(|(channel, entry)| Some((channel, entry?)))
    };
}

impl ColumnMap {
    /// The JSON schema of such a file.
    pub fn schema() -> Schema {
        schema_for!(MapFile)
    }

    /// Reads a column map from a TOML file.
    ///
    /// # Errors
    ///
    /// [`FormatError::Missing`], and [`LogError::Map`] for a file that is not TOML, an unknown key
    /// or unit, a scale or offset that is not finite, or a scale of zero.
    pub fn load(path: &Path) -> Result<Self, LogError> {
        if !path.exists() {
            return Err(FormatError::Missing { path: path.to_owned() }.into());
        }
        Self::new(path, Document::read(path).map_err(LogError::map)?)
    }

    /// A column map that is built in; errors give its place as `name`.
    pub(crate) fn from_text(name: &str, text: &str) -> Result<Self, LogError> {
        Self::new(Path::new(name), Document::from_text(name, text).map_err(LogError::map)?)
    }

    fn new(path: &Path, document: Document) -> Result<Self, LogError> {
        let file: MapFile = document.parse().map_err(LogError::map)?;
        let joint = file.joint.into_iter().map(|(name, map)| (name, by_channel!(map).collect()));
        let map = Self {
            path: path.to_owned(),
            time: file.time,
            rate_hz: file.rate_hz,
            joints: file.joints,
            joint: joint.collect(),
            patterns: by_channel!(file).collect(),
            document,
        };
        map.check_rate()?;
        map.entries().try_for_each(|(path, column)| map.usable(&path, column))?;
        Ok(map)
    }

    /// Refuses a rate that is no number of rows per second, and one beside a column of time.
    fn check_rate(&self) -> Result<(), LogError> {
        let Some(rate_hz) = self.rate_hz else { return Ok(()) };
        let message = match &self.time {
            Some(time) => format!(
                "found {rate_hz} Hz beside time = {:?}, one of them was expected",
                time.column
            ),
            None if rate_hz.is_finite() && rate_hz > 0.0 => return Ok(()),
            None => format!("found {rate_hz} Hz, a finite number greater than 0 was expected"),
        };
        let path = KeyPath::root().key("rate_hz");
        Err(LogError::map(self.document.mistake(&path, message, None)))
    }

    /// Refuses a scale or an offset that cannot give a signal.
    fn usable(&self, path: &KeyPath, column: &MappedColumn) -> Result<(), LogError> {
        let MappedColumn { scale, offset, .. } = column;
        if scale.is_finite() && scale.abs() > 0.0 && offset.is_finite() {
            return Ok(());
        }
        let message = format!(
            "found scale {scale} and offset {offset}, a finite scale other than 0 and a finite offset were expected"
        );
        Err(LogError::map(self.document.mistake(path, message, None)))
    }

    /// The map with every pattern expanded to one entry per joint, checked against the joints of this robot.
    ///
    /// # Errors
    ///
    /// [`LogError::MapUnknownJoint`], [`LogError::MapWrongUnit`], and [`LogError::Map`] for a
    /// pattern without exactly one column per joint.
    pub fn for_robot(&self, robot: &Robot) -> Result<Self, LogError> {
        let mut map = self.clone();
        let joints = match &self.joints {
            Some(joints) => joints.clone(),
            None => robot.joint_names().map(str::to_owned).collect(),
        };
        for (channel, pattern) in &self.patterns {
            let path = KeyPath::root().key(channel.suffix());
            let mistake = |message| LogError::map(self.document.mistake(&path, message, None));
            let columns = pattern.columns(&joints).map_err(mistake)?;
            for (joint, column) in joints.iter().zip(columns) {
                self.usable(&path, &column)?;
                map.joint.entry(joint.clone()).or_default().entry(*channel).or_insert(column);
            }
        }
        map.check(robot)?;
        Ok(map)
    }

    /// The entry for time.
    pub fn time(&self) -> Option<&MappedColumn> {
        self.time.as_ref()
    }

    /// Rows per second (Hz), for a file without time.
    pub fn rate_hz(&self) -> Option<f64> {
        self.rate_hz
    }

    /// The entry for a channel of a joint.
    pub fn channel(&self, joint: &str, channel: Channel) -> Option<&MappedColumn> {
        self.joint.get(joint)?.get(&channel)
    }

    /// The pattern of a channel for all joints, where it is one.
    pub(crate) fn pattern(&self, channel: Channel) -> Option<&str> {
        let (_, pattern) = self.patterns.iter().find(|(own, _)| *own == channel)?;
        match &pattern.column {
            Names::Pattern(pattern) => Some(pattern),
            Names::Each(_) => None,
        }
    }

    /// The map without the pattern of one channel, such as a velocity that was not recorded.
    pub(crate) fn without(&self, channel: Channel) -> Self {
        let mut map = self.clone();
        map.patterns.retain(|(own, _)| *own != channel);
        map
    }

    /// Checks that every joint in the map is a joint of this robot, and that every unit fits its signal.
    ///
    /// # Errors
    ///
    /// [`LogError::MapUnknownJoint`] and [`LogError::MapWrongUnit`].
    pub fn check(&self, robot: &Robot) -> Result<(), LogError> {
        self.check_unit("time", self.time.as_ref(), Quantity::Time)?;
        for (joint, map) in &self.joint {
            let Some(index) = robot.joint_index(joint) else {
                return Err(LogError::MapUnknownJoint {
                    path: self.path.clone(),
                    joint: joint.clone(),
                    expected: robot.joint_names().map(str::to_owned).collect(),
                    nearest: nearest(joint, robot.joint_names()),
                });
            };
            let kind = robot.links()[index].joint.kind;
            for (channel, column) in map {
                let key = format!("joint.{joint}.{}", channel.suffix());
                self.check_unit(&key, Some(column), Quantity::of(*channel, kind))?;
            }
        }
        Ok(())
    }

    fn check_unit(
        &self,
        key: &str,
        column: Option<&MappedColumn>,
        expected: Quantity,
    ) -> Result<(), LogError> {
        let Some(unit) = column.and_then(|c| c.unit) else { return Ok(()) };
        let found = unit.quantity();
        if found == expected || (found == Quantity::Any && expected != Quantity::Time) {
            return Ok(());
        }
        Err(LogError::MapWrongUnit {
            path: self.path.clone(),
            key: key.to_owned(),
            found: unit.to_string(),
            expected: expected.words(),
        })
    }

    fn entries(&self) -> impl Iterator<Item = (KeyPath, &MappedColumn)> {
        let time = self.time.iter().map(|c| (KeyPath::root().key("time"), c));
        let joints = self.joint.iter().flat_map(|(joint, map)| {
            let at = KeyPath::root().key("joint").key(joint.clone());
            map.iter().map(move |(channel, column)| (at.key(channel.suffix()), column))
        });
        time.chain(joints)
    }
}

impl LogError {
    /// An error in a column map.
    pub(crate) fn map(problem: DocumentError) -> Self {
        Self::Map { problem: Box::new(problem) }
    }
}
