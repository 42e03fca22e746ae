use std::{collections::BTreeMap, path::PathBuf};

use crate::runs::repair::Repair;

/// One recorded run, its joints in the order of the robot.
///
/// Every signal has one value per entry of `time`.
#[derive(Debug, Clone, PartialEq)]
pub struct Run {
    /// Name of the run: the name of the file without its extension.
    pub name: String,
    /// The file.
    pub source: PathBuf,
    /// SHA-256 of the file, in hexadecimal; empty for a run that was never a file.
    pub sha256: String,
    /// Whether the file ended in the middle of a row. That row is left out.
    pub is_torn: bool,
    /// Changes made while the run was read.
    pub mended: Vec<Repair>,
    /// Time of each sample as in the file (s), strictly increasing.
    pub time: Vec<f64>,
    /// Signals of each joint of the robot.
    pub joints: Vec<Channels>,
    /// Further numeric columns, under their names in the file; they may hold NaN.
    pub extra: BTreeMap<String, Vec<f64>>,
}

/// Signals of one joint. Position and effort are always present.
///
/// Units are rad and N·m for a rotation, m and N for a translation. A positive effort
/// accelerates the joint in the positive direction.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Channels {
    /// Name of the joint.
    pub name: String,
    /// Position (rad or m).
    pub position: Vec<f64>,
    /// Effort at the joint (N·m or N).
    pub effort: Vec<f64>,
    /// Velocity (rad/s or m/s).
    pub velocity: Option<Vec<f64>>,
    /// Acceleration (rad/s² or m/s²).
    pub acceleration: Option<Vec<f64>>,
    /// Position commanded to the controller (rad or m).
    pub desired_position: Option<Vec<f64>>,
    /// Velocity commanded to the controller (rad/s or m/s).
    pub desired_velocity: Option<Vec<f64>>,
    /// Acceleration commanded to the controller (rad/s² or m/s²).
    pub desired_acceleration: Option<Vec<f64>>,
    /// Effort commanded to the drive (N·m or N).
    pub commanded_effort: Option<Vec<f64>>,
    /// Position of the link from a second encoder (rad or m); `position` is then that of the motor.
    pub link_position: Option<Vec<f64>>,
    /// Part of the effort that follows the goal, where efforts are computed from goals.
    pub goal_effort: Option<GoalEffort>,
}

/// The part `kp goal(t - delay)` of an effort that is computed from goals.
#[derive(Debug, Clone, PartialEq)]
pub struct GoalEffort {
    /// Its samples (N·m or N), `lead` of them before the first sample of the run.
    pub values: Vec<f64>,
    /// Number of samples before the first one of the run, from which later goals are known.
    pub lead: usize,
    /// The delay with which it was computed, that of the robot's description (s).
    pub delay_s: f64,
}

impl GoalEffort {
    /// The same with other samples.
    #[must_use]
    pub fn map(&self, change: impl FnOnce(&[f64]) -> Vec<f64>) -> Self {
        Self { values: change(&self.values), ..*self }
    }
}

impl Run {
    /// The run without the samples within each of the intervals of time (s), both ends included.
    #[must_use]
    pub fn without(&self, seconds: &[[f64; 2]]) -> Self {
        let is_left = |t: &f64| !seconds.iter().any(|[from, to]| (*from..=*to).contains(t));
        let left: Vec<bool> = self.time.iter().map(is_left).collect();
        self.with_rows(&left)
    }

    /// Joints of the log that are not in the robot, found by their position columns.
    pub(crate) fn unknown_joints(&self) -> Vec<String> {
        self.extra.keys().filter_map(|n| n.strip_suffix(".position")).map(str::to_owned).collect()
    }

    /// The run reduced to the samples whose entry in `left` is true.
    pub(crate) fn with_rows(&self, left: &[bool]) -> Self {
        let keep = |x: &Vec<f64>| -> Vec<f64> {
            x.iter().zip(left).filter(|(_, left)| **left).map(|(x, _)| *x).collect()
        };
        let some = |x: &Option<Vec<f64>>| x.as_ref().map(keep);
        let joint = |c: &Channels| Channels {
            name: c.name.clone(),
            position: keep(&c.position),
            effort: keep(&c.effort),
            velocity: some(&c.velocity),
            acceleration: some(&c.acceleration),
            desired_position: some(&c.desired_position),
            desired_velocity: some(&c.desired_velocity),
            desired_acceleration: some(&c.desired_acceleration),
            commanded_effort: some(&c.commanded_effort),
            link_position: some(&c.link_position),
            goal_effort: c.goal_effort.as_ref().map(|goal| goal.map(|x| keep(&x.to_vec()))),
        };
        Self {
            name: self.name.clone(),
            source: self.source.clone(),
            sha256: self.sha256.clone(),
            is_torn: self.is_torn,
            mended: self.mended.clone(),
            time: keep(&self.time),
            joints: self.joints.iter().map(joint).collect(),
            extra: self.extra.iter().map(|(name, x)| (name.clone(), keep(x))).collect(),
        }
    }
}

/// The signals a joint may have.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Channel {
    /// Position (rad or m).
    Position,
    /// Velocity (rad/s or m/s).
    Velocity,
    /// Acceleration (rad/s² or m/s²).
    Acceleration,
    /// Effort (N·m or N).
    Effort,
    /// Desired position (rad or m).
    DesiredPosition,
    /// Desired velocity (rad/s or m/s).
    DesiredVelocity,
    /// Desired acceleration (rad/s² or m/s²).
    DesiredAcceleration,
    /// Commanded effort (N·m or N).
    CommandedEffort,
    /// Position of the link, from a second encoder (rad or m).
    LinkPosition,
}

impl Channel {
    /// Every channel, in the order in which files are written.
    pub const ALL: [Self; 9] = [
        Self::Position,
        Self::Velocity,
        Self::Acceleration,
        Self::Effort,
        Self::DesiredPosition,
        Self::DesiredVelocity,
        Self::DesiredAcceleration,
        Self::CommandedEffort,
        Self::LinkPosition,
    ];

    /// Suffix of a column's name, after the joint's name and a dot.
    pub fn suffix(self) -> &'static str {
        match self {
            Self::Position => "position",
            Self::Velocity => "velocity",
            Self::Acceleration => "acceleration",
            Self::Effort => "effort",
            Self::DesiredPosition => "desired_position",
            Self::DesiredVelocity => "desired_velocity",
            Self::DesiredAcceleration => "desired_acceleration",
            Self::CommandedEffort => "commanded_effort",
            Self::LinkPosition => "link_position",
        }
    }

    /// Whether a log without this channel is refused.
    pub fn is_required(self) -> bool {
        matches!(self, Self::Position | Self::Effort)
    }
}

impl Channels {
    /// The samples of a channel; `None` where the log does not have the channel.
    pub fn get(&self, channel: Channel) -> Option<&[f64]> {
        match channel {
            Channel::Position => Some(&self.position),
            Channel::Effort => Some(&self.effort),
            Channel::Velocity => self.velocity.as_deref(),
            Channel::Acceleration => self.acceleration.as_deref(),
            Channel::DesiredPosition => self.desired_position.as_deref(),
            Channel::DesiredVelocity => self.desired_velocity.as_deref(),
            Channel::DesiredAcceleration => self.desired_acceleration.as_deref(),
            Channel::CommandedEffort => self.commanded_effort.as_deref(),
            Channel::LinkPosition => self.link_position.as_deref(),
        }
    }

    /// Sets the samples of a channel.
    pub fn set(&mut self, channel: Channel, samples: Vec<f64>) {
        match channel {
            Channel::Position => self.position = samples,
            Channel::Effort => self.effort = samples,
            Channel::Velocity => self.velocity = Some(samples),
            Channel::Acceleration => self.acceleration = Some(samples),
            Channel::DesiredPosition => self.desired_position = Some(samples),
            Channel::DesiredVelocity => self.desired_velocity = Some(samples),
            Channel::DesiredAcceleration => self.desired_acceleration = Some(samples),
            Channel::CommandedEffort => self.commanded_effort = Some(samples),
            Channel::LinkPosition => self.link_position = Some(samples),
        }
    }
}

/// Smallest and largest value of a signal; `(0, 0)` for an empty one.
pub(crate) fn range(x: &[f64]) -> (f64, f64) {
    let low = x.iter().copied().reduce(f64::min).unwrap_or(0.0);
    let high = x.iter().copied().reduce(f64::max).unwrap_or(0.0);
    (low, high)
}

/// Median of a signal; 0 for an empty one.
pub(crate) fn median(x: &[f64]) -> f64 {
    let mut values = x.to_vec();
    let middle = values.len() / 2;
    if values.is_empty() { 0.0 } else { *values.select_nth_unstable_by(middle, f64::total_cmp).1 }
}

/// A run's name for a sentence: `run wipe`, but `run_2` alone, which already begins with the word.
pub fn of_run(name: &str) -> String {
    let says_so = name.get(..3).is_some_and(|first| first.eq_ignore_ascii_case("run"));
    if says_so { name.to_owned() } else { format!("run {name}") }
}
