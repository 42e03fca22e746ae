use std::{
    collections::BTreeMap,
    path::{Path, PathBuf},
};

use document::{Document, DocumentError, KeyPath};
use log_formats::FormatError;
use robot::Robot;
use serde::Deserialize;

use crate::{
    error::LogError,
    naming::{
        map_entry::{MappedColumn, Pattern},
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
    joints: Option<Vec<String>>,
    patterns: Vec<(Channel, Pattern)>,
    joint: BTreeMap<String, BTreeMap<Channel, MappedColumn>>,
}

/// Two maps are equal when their entries are equal.
impl PartialEq for ColumnMap {
    fn eq(&self, other: &Self) -> bool {
        (&self.path, &self.time, &self.joints, &self.patterns, &self.joint)
            == (&other.path, &other.time, &other.joints, &other.patterns, &other.joint)
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct MapFile {
    time: Option<MappedColumn>,
    joints: Option<Vec<String>>,
    position: Option<Pattern>,
    velocity: Option<Pattern>,
    acceleration: Option<Pattern>,
    effort: Option<Pattern>,
    desired_position: Option<Pattern>,
    desired_velocity: Option<Pattern>,
    desired_acceleration: Option<Pattern>,
    commanded_effort: Option<Pattern>,
    link_position: Option<Pattern>,
    #[serde(default)]
    joint: BTreeMap<String, JointMap>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct JointMap {
    position: Option<MappedColumn>,
    velocity: Option<MappedColumn>,
    acceleration: Option<MappedColumn>,
    effort: Option<MappedColumn>,
    desired_position: Option<MappedColumn>,
    desired_velocity: Option<MappedColumn>,
    desired_acceleration: Option<MappedColumn>,
    commanded_effort: Option<MappedColumn>,
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
            joints: file.joints,
            joint: joint.collect(),
            patterns: by_channel!(file).collect(),
            document,
        };
        map.entries().try_for_each(|(path, column)| map.usable(&path, column))?;
        Ok(map)
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

    /// The entry for a channel of a joint.
    pub fn channel(&self, joint: &str, channel: Channel) -> Option<&MappedColumn> {
        self.joint.get(joint)?.get(&channel)
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
