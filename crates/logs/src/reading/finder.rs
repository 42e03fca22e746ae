use std::{collections::BTreeSet, path::Path};

use log_formats::FormatError;
use robot::Robot;

use crate::{
    error::LogError,
    naming::nearest::nearest,
    reading::{options::ReadOptions, source::Source},
    runs::run::Channel,
};

/// Finds the columns of the signals.
pub(crate) struct Finder<'f, 'a> {
    pub path: &'f Path,
    pub names: &'f [String],
    pub is_unnamed: bool,
    pub options: &'f ReadOptions<'a>,
}

impl<'a> Finder<'_, 'a> {
    pub(crate) fn joint(
        &self,
        joint: &str,
        robot: &Robot,
    ) -> Result<Vec<(Channel, Source<'a>)>, LogError> {
        let mut sources = Vec::new();
        let is_computed = self.is_effort_computed(robot);
        for channel in Channel::ALL.into_iter().filter(|c| !is_computed || *c != Channel::Effort) {
            let source = self.source(joint, channel);
            if self.names.contains(&source.column) {
                sources.push((channel, source));
            } else if source.mapped.is_some() {
                let purpose = format!(
                    "the column map names it for the {} of joint {joint}{}",
                    channel.suffix(),
                    self.other_effort(joint, channel)
                );
                return Err(self.no_column(&source.column, &purpose, robot, Some(channel)));
            } else if channel.is_required() {
                return Err(self.absent(joint, channel, source.column, robot));
            } else if is_computed && channel == Channel::DesiredPosition {
                let purpose = format!(
                    "the goal of joint {joint}, which effort_source in robot.toml computes its effort from, was expected there"
                );
                return Err(self.no_column(&source.column, &purpose, robot, Some(channel)));
            }
        }
        Ok(sources)
    }

    /// Whether the efforts are computed from the robot's position loop, and no other effort was asked for.
    pub(crate) fn is_effort_computed(&self, robot: &Robot) -> bool {
        self.options.effort == Channel::Effort.suffix()
            && robot.links().iter().all(|link| link.actuator.position_loop.is_some())
    }

    /// End of the error for a missing effort: a hint at `effort_source`, where the log has a desired position.
    fn other_effort(&self, joint: &str, channel: Channel) -> &'static str {
        let goal = self.source(joint, Channel::DesiredPosition).column;
        if channel == Channel::Effort && self.names.contains(&goal) {
            ", or effort_source in robot.toml for servos whose logs hold none"
        } else {
            ""
        }
    }

    fn source(&self, joint: &str, channel: Channel) -> Source<'a> {
        let suffix = match channel {
            Channel::Effort => self.options.effort,
            _ => channel.suffix(),
        };
        // The map describes the usual effort, not another one that was asked for.
        let usual = suffix == channel.suffix();
        let mapped = self.options.map.filter(|_| usual).and_then(|m| m.channel(joint, channel));
        let column = mapped.map_or_else(|| format!("{joint}.{suffix}"), |m| m.column.clone());
        Source { column, mapped }
    }

    fn absent(&self, joint: &str, channel: Channel, column: String, robot: &Robot) -> LogError {
        if self.is_unnamed {
            return self.no_names();
        }
        let prefix = format!("{joint}.");
        let own = |name: &&String| name.starts_with(&prefix);
        if channel != Channel::Position || self.names.iter().any(|n| own(&n)) {
            let purpose = format!(
                "the {} of joint {joint} was expected there{}",
                channel.suffix(),
                self.other_effort(joint, channel)
            );
            // A column of another joint, or of another of its signals, is no misspelling of this one.
            let is_other = |name: &&String| {
                Channel::ALL.iter().any(|c| **name == format!("{joint}.{}", c.suffix()))
            };
            let like = self.names.iter().filter(own).filter(|name| !is_other(name));
            let nearest = nearest(&column, like.map(String::as_str));
            let path = self.path.to_owned();
            let others = self.joints_with_effort(robot);
            if channel == Channel::Effort && nearest.is_none() && !others.is_empty() {
                let hint = self.other_effort(joint, channel);
                let what = format!("there is no column {column}{hint}").into();
                let (joint, found) = (joint.to_owned(), self.names.into());
                return LogError::EffortAbsent { path, joint, what, others, found };
            }
            let found = self.names.into();
            return FormatError::NoColumn { path, column, purpose, nearest, found }.into();
        }
        let found: Box<[String]> = self
            .names
            .iter()
            .filter_map(|n| n.strip_suffix(".position"))
            .map(str::to_owned)
            .collect();
        let strange = found.iter().map(String::as_str).filter(|n| robot.joint_index(n).is_none());
        let nearest = nearest(joint, strange);
        let position = |joint: &str| self.source(joint, Channel::Position).column;
        let has = |joint: &&str| self.names.iter().any(|n| *n == position(joint));
        let shared = robot.joint_names().filter(has).map(str::to_owned).collect();
        LogError::JointAbsent {
            path: self.path.to_owned(),
            joint: joint.into(),
            column: column.into(),
            shared,
            other: if found.is_empty() { self.names.into() } else { Box::default() },
            found,
            nearest: nearest.map(Into::into),
        }
    }

    /// The joints of the robot whose effort has a column.
    fn joints_with_effort(&self, robot: &Robot) -> Box<[String]> {
        let has = |joint: &&str| self.names.contains(&self.source(joint, Channel::Effort).column);
        robot.joint_names().filter(has).map(str::to_owned).collect()
    }

    fn no_names(&self) -> LogError {
        LogError::NoNames { path: self.path.to_owned(), columns: self.names.len() }
    }

    /// A column of a channel, or else of time, that is missing; the column of another channel is no misspelling of it.
    pub(crate) fn no_column(
        &self,
        column: &str,
        purpose: &str,
        robot: &Robot,
        channel: Option<Channel>,
    ) -> LogError {
        if self.is_unnamed {
            return self.no_names();
        }
        let signals = robot.joint_names().flat_map(|joint| {
            let others = Channel::ALL.into_iter().filter(|other| Some(*other) != channel);
            others.map(|other| self.source(joint, other).column)
        });
        let signals: BTreeSet<String> = signals.collect();
        let unread = self.names.iter().filter(|name| !signals.contains(*name));
        FormatError::NoColumn {
            path: self.path.to_owned(),
            column: column.to_owned(),
            purpose: purpose.to_owned(),
            nearest: nearest(column, unread.map(String::as_str)),
            found: self.names.into(),
        }
        .into()
    }
}
