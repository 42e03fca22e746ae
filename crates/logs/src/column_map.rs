use std::{
    collections::BTreeMap,
    fs,
    path::{Path, PathBuf},
};

use robot::Robot;
use serde::Deserialize;

use crate::{Channel, LogError, Unit, error::nearest, unit::Quantity};

/// Names and units of the columns of a file that has its own.
///
/// ```toml
/// time = { column = "t_ns", unit = "ns" }
///
/// [joint.shoulder]
/// position = { column = "q0", unit = "deg" }
/// effort = { column = "i0", unit = "raw", scale = 0.12 }   # N m per ampere
/// ```
///
/// Channels without an entry are looked for under their usual name.
#[derive(Debug, Clone, PartialEq)]
pub struct ColumnMap {
    path: PathBuf,
    time: Option<MappedColumn>,
    joint: BTreeMap<String, JointMap>,
}

/// Where a signal is found in a file, and how it is converted:
///
/// ```text
/// signal = scale * factor(unit) * value + offset
/// ```
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MappedColumn {
    /// Name of the column.
    pub column: String,
    /// Unit of the values in the file; SI and radians where it is left out.
    pub unit: Option<Unit>,
    /// Factor, such as a torque constant or the sign of an axis.
    #[serde(default = "one")]
    pub scale: f64,
    /// Added last, in SI units and radians.
    #[serde(default)]
    pub offset: f64,
}

fn one() -> f64 {
    1.0
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct MapFile {
    time: Option<MappedColumn>,
    #[serde(default)]
    joint: BTreeMap<String, JointMap>,
}

#[derive(Debug, Clone, PartialEq, Deserialize)]
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

impl JointMap {
    fn get(&self, channel: Channel) -> Option<&MappedColumn> {
        match channel {
            Channel::Position => self.position.as_ref(),
            Channel::Velocity => self.velocity.as_ref(),
            Channel::Acceleration => self.acceleration.as_ref(),
            Channel::Effort => self.effort.as_ref(),
            Channel::DesiredPosition => self.desired_position.as_ref(),
            Channel::DesiredVelocity => self.desired_velocity.as_ref(),
            Channel::DesiredAcceleration => self.desired_acceleration.as_ref(),
            Channel::CommandedEffort => self.commanded_effort.as_ref(),
            Channel::LinkPosition => self.link_position.as_ref(),
        }
    }
}

impl MappedColumn {
    /// A value of the file as a signal (SI units, radians).
    pub fn convert(&self, value: f64) -> f64 {
        self.scale * self.unit.map_or(1.0, Unit::factor) * value + self.offset
    }
}

impl ColumnMap {
    /// Reads a column map from a TOML file.
    ///
    /// # Errors
    ///
    /// [`LogError::Missing`], [`LogError::Unreadable`] and [`LogError::BadMap`] for a
    /// file that is not TOML, an unknown key or unit, a scale or offset that is not
    /// finite, or a scale of zero.
    pub fn load(path: &Path) -> Result<Self, LogError> {
        let text = fs::read_to_string(path).map_err(|e| match e.kind() {
            std::io::ErrorKind::NotFound => LogError::Missing { path: path.to_owned() },
            _ => LogError::Unreadable { path: path.to_owned(), reason: e.to_string() },
        })?;
        let bad = |reason: String| LogError::BadMap { path: path.to_owned(), reason };
        let file: MapFile = toml::from_str(&text).map_err(|e| bad(e.to_string()))?;
        let map = Self { path: path.to_owned(), time: file.time, joint: file.joint };
        for (key, column) in map.entries() {
            if !(column.scale.is_finite() && column.scale.abs() > 0.0 && column.offset.is_finite())
            {
                return Err(bad(format!(
                    "{key}: found scale {} and offset {}, a finite scale other than 0 and a finite offset were expected",
                    column.scale, column.offset
                )));
            }
        }
        Ok(map)
    }

    /// The entry for time.
    pub fn time(&self) -> Option<&MappedColumn> {
        self.time.as_ref()
    }

    /// The entry for a channel of a joint.
    pub fn channel(&self, joint: &str, channel: Channel) -> Option<&MappedColumn> {
        self.joint.get(joint)?.get(channel)
    }

    /// Checks that the map speaks of the joints of this robot, in units that fit them.
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
            for channel in Channel::ALL {
                let key = format!("joint.{joint}.{}", channel.suffix());
                self.check_unit(&key, map.get(channel), Quantity::of(channel, kind))?;
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

    fn entries(&self) -> impl Iterator<Item = (String, &MappedColumn)> {
        let time = self.time.iter().map(|c| ("time".to_owned(), c));
        let joints = self.joint.iter().flat_map(|(joint, map)| {
            Channel::ALL.into_iter().filter_map(move |channel| {
                Some((format!("joint.{joint}.{}", channel.suffix()), map.get(channel)?))
            })
        });
        time.chain(joints)
    }
}
