use std::{
    collections::BTreeMap,
    path::{Path, PathBuf},
};

use robot::{Joint, Link, Robot};

use crate::{
    Channel, Channels, ColumnMap, Excerpt, LogError, MappedColumn, Mend, ReadOptions,
    damage::Damage,
    degrees,
    error::nearest,
    excerpt::Excerpted,
    impossible::{few, impossible},
    log_file::LogFile,
    position_loop,
    table::{Needed, Table},
    turns::unwrapped,
};

/// Fewest rows of a log.
const FEWEST_ROWS: usize = 2;

/// Where one signal comes from.
pub(crate) struct Source<'a> {
    column: String,
    mapped: Option<&'a MappedColumn>,
}

impl Source<'_> {
    pub(crate) fn take(&self, columns: &BTreeMap<String, Vec<f64>>) -> Vec<f64> {
        let raw = columns.get(&self.column).map(Vec::as_slice).unwrap_or_default();
        match self.mapped {
            Some(mapped) => raw.iter().map(|&x| mapped.convert(x)).collect(),
            None => raw.to_vec(),
        }
    }
}

/// Which column becomes which signal.
pub(crate) struct Plan<'a> {
    path: PathBuf,
    pub time: Source<'a>,
    pub joints: Vec<Vec<(Channel, Source<'a>)>>,
    excerpt: Option<Excerpt>,
    /// Whether efforts are those of the position loop of the robot.
    pub is_effort_computed: bool,
}

impl<'a> Plan<'a> {
    pub(crate) fn new(
        path: &Path,
        file: &LogFile,
        robot: &Robot,
        options: &ReadOptions<'a>,
    ) -> Result<Self, LogError> {
        let names = &file.names(path)?;
        let finder = Finder { path, names, is_unnamed: file.is_unnamed(), options };
        let mapped = options.map.and_then(ColumnMap::time);
        let column = options.time().to_owned();
        if !names.contains(&column) {
            return Err(finder.no_column(&column, "the time of every row (s) was expected"));
        }
        let joints: Result<_, _> =
            robot.joint_names().map(|joint| finder.joint(joint, robot)).collect();
        Ok(Self {
            path: path.to_owned(),
            time: Source { column, mapped },
            joints: joints?,
            excerpt: options.excerpt,
            is_effort_computed: finder.is_effort_computed(robot),
        })
    }

    fn sources(&self) -> impl Iterator<Item = &Source<'a>> {
        let joints = self.joints.iter().flatten().map(|(_, source)| source);
        std::iter::once(&self.time).chain(joints)
    }

    /// The columns that become signals.
    pub(crate) fn needed(&self) -> Needed<'_> {
        let signals = self.joints.iter().flatten().map(|(_, source)| source.column.as_str());
        let excerpted = self.excerpt.map(|excerpt| Excerpted::new(excerpt, self.time.mapped));
        Needed { time: &self.time.column, signals: signals.collect(), excerpted }
    }

    /// Whether an excerpt that was asked for has two rows or more.
    ///
    /// # Errors
    ///
    /// [`LogError::ExcerptTooShort`].
    pub(crate) fn check_excerpt(&self, table: &Table) -> Result<(), LogError> {
        let found = table.columns.get(&self.time.column).map_or(0, Vec::len);
        match self.excerpt.filter(|_| found < FEWEST_ROWS) {
            None => Ok(()),
            Some(excerpt) => {
                let (path, expected) = (self.path.clone(), FEWEST_ROWS);
                Err(LogError::ExcerptTooShort { path, excerpt, found, expected })
            }
        }
    }

    /// Two rows or more, finite numbers, time that increases; what is not is cut off with what
    /// follows, where damage may be.
    pub(crate) fn check(&self, table: &mut Table, damage: &mut Damage) -> Result<(), LogError> {
        // Behind a number that is none, time may go back before it: at most once a signal.
        for _ in 0..=self.sources().count() {
            let Some((sample, error)) = self.damaged(table) else { break };
            damage.take(error)?;
            table.truncate(sample);
        }
        let path = || self.path.clone();
        let time = self.time.take(&table.columns);
        if time.len() < FEWEST_ROWS {
            let (found, expected) = (time.len(), FEWEST_ROWS);
            return Err(LogError::TooFewRows { path: path(), found, expected });
        }
        self.damaged(table).map_or(Ok(()), |(_, error)| Err(error))
    }

    /// The first sample that cannot be used, and why.
    fn damaged(&self, table: &Table) -> Option<(usize, LogError)> {
        let path = || self.path.clone();
        let time = self.time.take(&table.columns);
        for source in self.sources() {
            let samples = source.take(&table.columns);
            if let Some(index) = samples.iter().position(|x| !x.is_finite()) {
                let (row, column) = (table.row(index), source.column.clone());
                let found = samples[index].to_string();
                return Some((index, LogError::NotFinite { path: path(), row, column, found }));
            }
        }
        let index = time.windows(2).position(|t| t[1] <= t[0])?;
        let error = LogError::TimeNotIncreasing {
            path: path(),
            row: table.row(index + 1),
            column: self.time.column.clone(),
            previous: time[index],
            found: time[index + 1],
        };
        Some((index + 1, error))
    }

    /// The signals of every joint, taken out of the table: it keeps the columns that become none.
    pub(crate) fn take_channels(&self, robot: &Robot, table: &mut Table) -> Vec<Channels> {
        let time = self.time.take(&table.columns);
        let mut all = Vec::with_capacity(self.joints.len());
        for (j, (link, sources)) in robot.links().iter().zip(&self.joints).enumerate() {
            all.push(self.channels((link, sources), &time, table));
            let later = || self.joints[j + 1..].iter().flatten();
            for (_, Source { column, .. }) in sources {
                if !later().any(|(_, source)| source.column == *column) {
                    table.columns.remove(column);
                }
            }
        }
        table.columns.remove(&self.time.column);
        all
    }

    /// The signals of one joint.
    fn channels(
        &self,
        (link, sources): (&Link, &[(Channel, Source)]),
        time: &[f64],
        table: &Table,
    ) -> Channels {
        let mut channels = Channels { name: link.joint.name.clone(), ..Channels::default() };
        for (channel, source) in sources {
            channels.set(*channel, source.take(&table.columns));
        }
        if let Some(gain) = link.actuator.position_loop.filter(|_| self.is_effort_computed) {
            channels.effort = position_loop::effort(gain, time, &channels);
        }
        channels
    }

    /// Leaves out the rows with samples that cannot be.
    ///
    /// # Errors
    ///
    /// [`LogError::Impossible`] where those are more than a few, unless they look like degrees, which
    /// [`Plan::check_degrees`] tells.
    pub(crate) fn leave_out_impossible(
        &self,
        robot: &Robot,
        table: &mut Table,
    ) -> Result<Vec<Mend>, LogError> {
        let time = self.time.take(&table.columns);
        let mut all = Vec::new();
        let mut mended = Vec::new();
        for (link, sources) in robot.links().iter().zip(&self.joints) {
            let (joint, channels) = (&link.joint, self.channels((link, sources), &time, table));
            for (channel, found) in impossible(joint, &time, &channels) {
                let Some(first) = found.first() else { continue };
                let (row, count) = (table.row(first.sample), found.len());
                let source = sources.iter().find(|(c, _)| *c == channel);
                let column = source.map_or_else(
                    || format!("{}.{} (of effort_source)", joint.name, channel.suffix()),
                    |(_, source)| source.column.clone(),
                );
                let value = channels.get(channel).map_or(f64::NAN, |x| x[first.sample]);
                let expectation = first.expectation.clone();
                if count > few(time.len()) {
                    self.check_degrees(joint, sources, (&time, table), &channels)?;
                    let (path, rows) = (self.path.clone(), time.len());
                    let few = few(rows);
                    return Err(LogError::Impossible {
                        path,
                        column,
                        row,
                        found: value,
                        expectation,
                        count,
                        rows,
                        few,
                    });
                }
                mended.push(Mend::LeftOut { column, row, found: value, expectation, count });
                all.extend(found.into_iter().map(|i| i.sample));
            }
        }
        all.sort_unstable();
        all.dedup();
        if !all.is_empty() {
            table.leave_out(&all);
        }
        Ok(mended)
    }

    /// Takes out of the positions of a rotation the full turns that they jump by.
    pub(crate) fn unwrap(
        &self,
        sources: &[(Channel, Source)],
        (time, table): (&[f64], &Table),
        channels: &mut Channels,
    ) -> Vec<Mend> {
        let mut mended = Vec::new();
        for (channel, source) in sources.iter().filter(|(c, _)| *c == Channel::Position) {
            let Some(found) = unwrapped(time, &channels.position) else { continue };
            let (row, count) = (table.row(found.jumps[0]), found.jumps.len());
            channels.set(*channel, found.position);
            mended.push(Mend::Turns { column: source.column.clone(), row, count });
        }
        mended
    }

    /// A unit that was stated is believed.
    pub(crate) fn check_degrees(
        &self,
        joint: &Joint,
        sources: &[(Channel, Source)],
        (time, table): (&[f64], &Table),
        channels: &Channels,
    ) -> Result<(), LogError> {
        let unstated = |channel: Channel| {
            let found = sources.iter().find(|(c, _)| *c == channel).map(|(_, source)| source);
            found.filter(|s| s.mapped.is_none_or(|m| m.unit.is_none()))
        };
        let looks = |source: &Source, samples: &[f64], expectation: String| {
            let (index, found) = degrees::farthest(samples);
            LogError::LooksLikeDegrees {
                path: self.path.clone(),
                column: source.column.clone(),
                row: table.row(index),
                found,
                joint: joint.name.clone(),
                expectation,
            }
        };
        if let Some(source) = unstated(Channel::Position)
            && let Some(expectation) = degrees::evidence(joint, time, channels)
        {
            return Err(looks(source, &channels.position, expectation));
        }
        if let Some(source) = unstated(Channel::LinkPosition)
            && let Some(link) = &channels.link_position
            && let Some(expectation) = degrees::link_evidence(joint, &channels.position, link)
        {
            return Err(looks(source, link, expectation));
        }
        Ok(())
    }
}

/// Looks for the columns of the signals.
struct Finder<'f, 'a> {
    path: &'f Path,
    names: &'f [String],
    is_unnamed: bool,
    options: &'f ReadOptions<'a>,
}

impl<'a> Finder<'_, 'a> {
    fn joint(&self, joint: &str, robot: &Robot) -> Result<Vec<(Channel, Source<'a>)>, LogError> {
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
                return Err(self.no_column(&source.column, &purpose));
            } else if channel.is_required() {
                return Err(self.absent(joint, channel, source.column, robot));
            } else if is_computed && channel == Channel::DesiredPosition {
                let purpose = format!(
                    "the goal of joint {joint}, which effort_source in robot.toml computes its effort from, was expected there"
                );
                return Err(self.no_column(&source.column, &purpose));
            }
        }
        Ok(sources)
    }

    /// Whether the robot's efforts are those of a position loop, and no other effort is asked for.
    fn is_effort_computed(&self, robot: &Robot) -> bool {
        self.options.effort == Channel::Effort.suffix()
            && robot.links().iter().all(|link| link.actuator.position_loop.is_some())
    }

    /// What there is instead of an effort that is missing beside a goal.
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
            return self.unnamed();
        }
        let prefix = format!("{joint}.");
        let own = |name: &&String| name.starts_with(&prefix);
        if channel != Channel::Position || self.names.iter().any(|n| own(&n)) {
            let purpose = format!(
                "the {} of joint {joint} was expected there{}",
                channel.suffix(),
                self.other_effort(joint, channel)
            );
            // A column of another joint is no misspelling of this one's.
            let nearest = nearest(&column, self.names.iter().filter(own).map(String::as_str));
            return LogError::NoColumn { path: self.path.to_owned(), column, purpose, nearest };
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
            joint: joint.to_owned(),
            column: column.into(),
            shared,
            found,
            nearest,
        }
    }

    fn unnamed(&self) -> LogError {
        LogError::NoNames { path: self.path.to_owned(), columns: self.names.len() }
    }

    fn no_column(&self, column: &str, purpose: &str) -> LogError {
        if self.is_unnamed {
            return self.unnamed();
        }
        LogError::NoColumn {
            path: self.path.to_owned(),
            column: column.to_owned(),
            purpose: purpose.to_owned(),
            nearest: nearest(column, self.names.iter().map(String::as_str)),
        }
    }
}
