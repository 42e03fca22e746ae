use std::{f64::consts::PI, fmt};

use robot::JointKind;
use schemars::JsonSchema;
use serde::Deserialize;

use crate::runs::run::Channel;

/// A unit that a column map may name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[non_exhaustive]
pub enum Unit {
    /// Seconds.
    #[serde(rename = "s")]
    Second,
    /// Milliseconds.
    #[serde(rename = "ms")]
    Millisecond,
    /// Microseconds.
    #[serde(rename = "us")]
    Microsecond,
    /// Nanoseconds.
    #[serde(rename = "ns")]
    Nanosecond,
    /// Radians.
    #[serde(rename = "rad")]
    Radian,
    /// Degrees.
    #[serde(rename = "deg")]
    Degree,
    /// Revolutions.
    #[serde(rename = "rev")]
    Revolution,
    /// Radians per second.
    #[serde(rename = "rad/s")]
    RadianPerSecond,
    /// Degrees per second.
    #[serde(rename = "deg/s")]
    DegreePerSecond,
    /// Revolutions per minute.
    #[serde(rename = "rpm")]
    RevolutionPerMinute,
    /// Radians per second squared.
    #[serde(rename = "rad/s^2")]
    RadianPerSecondSquared,
    /// Degrees per second squared.
    #[serde(rename = "deg/s^2")]
    DegreePerSecondSquared,
    /// Metres.
    #[serde(rename = "m")]
    Metre,
    /// Millimetres.
    #[serde(rename = "mm")]
    Millimetre,
    /// Metres per second.
    #[serde(rename = "m/s")]
    MetrePerSecond,
    /// Millimetres per second.
    #[serde(rename = "mm/s")]
    MillimetrePerSecond,
    /// Metres per second squared.
    #[serde(rename = "m/s^2")]
    MetrePerSecondSquared,
    /// Newton metres.
    #[serde(rename = "N m")]
    NewtonMetre,
    /// Newton millimetres, the same as millinewton metres.
    #[serde(rename = "mN m")]
    MillinewtonMetre,
    /// Newtons.
    #[serde(rename = "N")]
    Newton,
    /// A number in another unit, such as a motor current (A); `scale` converts it to an effort.
    #[serde(rename = "raw")]
    Raw,
}

/// What a unit measures.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Quantity {
    Time,
    Angle,
    AngularVelocity,
    AngularAcceleration,
    Length,
    Velocity,
    Acceleration,
    Torque,
    Force,
    Any,
}

impl Unit {
    /// Factor from this unit to SI units and radians: `si = factor * value`.
    pub fn factor(self) -> f64 {
        match self {
            Self::Millisecond | Self::Millimetre | Self::MillimetrePerSecond => 1e-3,
            Self::MillinewtonMetre => 1e-3,
            Self::Microsecond => 1e-6,
            Self::Nanosecond => 1e-9,
            Self::Degree | Self::DegreePerSecond | Self::DegreePerSecondSquared => PI / 180.0,
            Self::Revolution => 2.0 * PI,
            Self::RevolutionPerMinute => 2.0 * PI / 60.0,
            _ => 1.0,
        }
    }

    pub(crate) fn quantity(self) -> Quantity {
        match self {
            Self::Second | Self::Millisecond | Self::Microsecond | Self::Nanosecond => {
                Quantity::Time
            }
            Self::Radian | Self::Degree | Self::Revolution => Quantity::Angle,
            Self::RadianPerSecond | Self::DegreePerSecond | Self::RevolutionPerMinute => {
                Quantity::AngularVelocity
            }
            Self::RadianPerSecondSquared | Self::DegreePerSecondSquared => {
                Quantity::AngularAcceleration
            }
            Self::Metre | Self::Millimetre => Quantity::Length,
            Self::MetrePerSecond | Self::MillimetrePerSecond => Quantity::Velocity,
            Self::MetrePerSecondSquared => Quantity::Acceleration,
            Self::NewtonMetre | Self::MillinewtonMetre => Quantity::Torque,
            Self::Newton => Quantity::Force,
            Self::Raw => Quantity::Any,
        }
    }
}

impl fmt::Display for Unit {
    /// Name of the unit in a column map.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Second => "s",
            Self::Millisecond => "ms",
            Self::Microsecond => "us",
            Self::Nanosecond => "ns",
            Self::Radian => "rad",
            Self::Degree => "deg",
            Self::Revolution => "rev",
            Self::RadianPerSecond => "rad/s",
            Self::DegreePerSecond => "deg/s",
            Self::RevolutionPerMinute => "rpm",
            Self::RadianPerSecondSquared => "rad/s^2",
            Self::DegreePerSecondSquared => "deg/s^2",
            Self::Metre => "m",
            Self::Millimetre => "mm",
            Self::MetrePerSecond => "m/s",
            Self::MillimetrePerSecond => "mm/s",
            Self::MetrePerSecondSquared => "m/s^2",
            Self::NewtonMetre => "N m",
            Self::MillinewtonMetre => "mN m",
            Self::Newton => "N",
            Self::Raw => "raw",
        })
    }
}

impl Quantity {
    /// What a channel of a rotation or a translation measures.
    pub(crate) fn of(channel: Channel, kind: JointKind) -> Self {
        use Channel::{
            Acceleration, CommandedEffort, DesiredAcceleration, DesiredPosition, DesiredVelocity,
            Effort, LinkPosition, Position, Velocity,
        };
        match (channel, kind.is_rotation()) {
            (Position | DesiredPosition | LinkPosition, true) => Self::Angle,
            (Position | DesiredPosition | LinkPosition, false) => Self::Length,
            (Velocity | DesiredVelocity, true) => Self::AngularVelocity,
            (Velocity | DesiredVelocity, false) => Self::Velocity,
            (Acceleration | DesiredAcceleration, true) => Self::AngularAcceleration,
            (Acceleration | DesiredAcceleration, false) => Self::Acceleration,
            (Effort | CommandedEffort, true) => Self::Torque,
            (Effort | CommandedEffort, false) => Self::Force,
        }
    }

    /// Name and units of the quantity, as the end of `a unit of ... was expected`.
    pub(crate) fn words(self) -> &'static str {
        match self {
            Self::Time => "time (s, ms, us, ns)",
            Self::Angle => "angle (rad, deg, rev, raw)",
            Self::AngularVelocity => "angular velocity (rad/s, deg/s, rpm, raw)",
            Self::AngularAcceleration => "angular acceleration (rad/s^2, deg/s^2, raw)",
            Self::Length => "length (m, mm, raw)",
            Self::Velocity => "velocity (m/s, mm/s, raw)",
            Self::Acceleration => "acceleration (m/s^2, raw)",
            Self::Torque => "torque (N m, mN m, raw)",
            Self::Force => "force (N, raw)",
            Self::Any => "any kind",
        }
    }
}
