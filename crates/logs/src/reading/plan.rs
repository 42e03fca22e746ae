use std::path::{Path, PathBuf};

use log_formats::{
    Damage, Excerpt, ExcerptFilter, FormatError, Needed, Opened, Table, column_names,
};
use robot::{Joint, Link, Robot};

use crate::{
    checks::{
        degrees,
        impossible::{find_impossible, most_left_out},
        lost_efforts::lost_efforts,
        turns::unwrap_turns,
    },
    error::LogError,
    naming::{column_map::ColumnMap, map_entry::MappedColumn},
    reading::{finder::Finder, options::ReadOptions, position_loop, source::Source},
    runs::{
        repair::Repair,
        run::{Channel, Channels},
    },
};

/// Fewest rows of a log.
const FEWEST_ROWS: usize = 2;

/// The column of each signal.
pub(crate) struct Plan<'a> {
    path: PathBuf,
    pub time: Source<'a>,
    pub joints: Vec<Vec<(Channel, Source<'a>)>>,
    excerpt: Option<Excerpt>,
    /// Whether efforts are computed from the position loop of the robot.
    pub is_effort_computed: bool,
}

impl<'a> Plan<'a> {
    pub(crate) fn new(
        path: &Path,
        file: &dyn Opened,
        robot: &Robot,
        options: &ReadOptions<'a>,
    ) -> Result<Self, LogError> {
        let names = &column_names(file, path)?;
        let finder = Finder { path, names, is_unnamed: file.is_unnamed(), options };
        let mapped = options.map.and_then(ColumnMap::time);
        let column = options.time().to_owned();
        if !names.contains(&column) {
            let purpose = "the time of every row (s) was expected";
            return Err(finder.no_column(&column, purpose, robot, None));
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
    pub(crate) fn needed_columns(&self) -> Needed<'_> {
        let signals = self.joints.iter().flatten().map(|(_, source)| source.column.as_str());
        let excerpt = self.excerpt.map(|excerpt| {
            ExcerptFilter::new(excerpt, self.time.mapped.map(MappedColumn::time_scale))
        });
        Needed { time: &self.time.column, signals: signals.collect(), excerpt }
    }

    /// Checks that an excerpt, where one was asked for, has at least two rows.
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

    /// Checks that there are at least two rows, that their numbers are finite and that time increases. A log that
    /// may be damaged is cut off before the first row that fails.
    ///
    /// # Errors
    ///
    /// [`LogError::EffortAbsent`] for a joint whose effort is a number in no row, where others have efforts, and the errors of
    /// such rows.
    pub(crate) fn check(
        &self,
        robot: &Robot,
        table: &mut Table,
        damage: &mut Damage,
    ) -> Result<(), LogError> {
        self.check_efforts(robot, table)?;
        // Cutting at a number that is not finite may leave an earlier row at which time goes back: one cut a signal at most.
        for _ in 0..=self.sources().count() {
            let Some((sample, error)) = self.first_damage(table) else { break };
            damage.take(error)?;
            table.truncate(sample);
        }
        let path = || self.path.clone();
        let time = self.time.take(&table.columns);
        if time.len() < FEWEST_ROWS {
            let (found, expected) = (time.len(), FEWEST_ROWS);
            return Err(LogError::TooFewRows { path: path(), found, expected });
        }
        self.first_damage(table).map_or(Ok(()), |(_, error)| Err(error.into()))
    }

    /// Checks that the effort of every joint is a number in some row, if that of any joint is.
    fn check_efforts(&self, robot: &Robot, table: &Table) -> Result<(), LogError> {
        let (mut others, mut absent) = (Vec::new(), None);
        for (joint, sources) in robot.joint_names().zip(&self.joints) {
            let column = sources.iter().find(|(channel, _)| *channel == Channel::Effort);
            let Some((_, Source { column, .. })) = column else { continue };
            let samples = table.columns.get(column).map(Vec::as_slice).unwrap_or_default();
            if samples.is_empty() || samples.iter().any(|x| x.is_finite()) {
                others.push(joint.to_owned());
            } else if absent.is_none() {
                let what = format!("column {column} holds no number in {} rows", samples.len());
                absent = Some((joint.to_owned(), what.into()));
            }
        }
        match absent {
            Some((joint, what)) if !others.is_empty() => {
                let (path, others) = (self.path.clone(), others.into());
                let found = Box::default();
                Err(LogError::EffortAbsent { path, joint, what, others, found })
            }
            _ => Ok(()),
        }
    }

    /// The first sample that cannot be used, and why.
    fn first_damage(&self, table: &Table) -> Option<(usize, FormatError)> {
        let path = || self.path.clone();
        let time = self.time.take(&table.columns);
        for source in self.sources() {
            let samples = source.take(&table.columns);
            if let Some(index) = samples.iter().position(|x| !x.is_finite()) {
                let (row, column) = (table.row(index), source.column.clone());
                let found = samples[index].to_string();
                return Some((index, FormatError::NotFinite { path: path(), row, column, found }));
            }
        }
        let index = time.windows(2).position(|t| t[1] <= t[0])?;
        let error = FormatError::TimeNotIncreasing {
            path: path(),
            row: table.row(index + 1),
            column: self.time.column.clone(),
            previous: time[index],
            found: time[index + 1],
        };
        Some((index + 1, error))
    }

    /// The signals of every joint, moved out of the table. The table keeps the further columns.
    pub(crate) fn take_channels(&self, robot: &Robot, table: &mut Table) -> Vec<Channels> {
        let time = self.time.take(&table.columns);
        let mut all = Vec::with_capacity(self.joints.len());
        for (j, (link, sources)) in robot.links().iter().zip(&self.joints).enumerate() {
            all.push(self.channels(link, sources, &time, table));
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
        link: &Link,
        sources: &[(Channel, Source)],
        time: &[f64],
        table: &Table,
    ) -> Channels {
        let mut channels = Channels { name: link.joint.name.clone(), ..Channels::default() };
        for (channel, source) in sources {
            channels.set(*channel, source.take(&table.columns));
        }
        if self.is_effort_computed {
            position_loop::compute_effort(&link.actuator, time, &mut channels);
        }
        channels
    }

    /// Leaves out the rows with impossible samples.
    ///
    /// # Errors
    ///
    /// [`LogError::Impossible`] for too many such rows, or the error of [`Plan::check_degrees`] where they look like
    /// degrees.
    pub(crate) fn leave_out_impossible(
        &self,
        robot: &Robot,
        table: &mut Table,
    ) -> Result<Vec<Repair>, LogError> {
        let time = self.time.take(&table.columns);
        let mut all = Vec::new();
        let mut mended = Vec::new();
        for (link, sources) in robot.links().iter().zip(&self.joints) {
            let (joint, channels) = (&link.joint, self.channels(link, sources, &time, table));
            let mut impossible = find_impossible(joint, &time, &channels);
            let is_told = impossible.iter().any(|(channel, _)| *channel == Channel::Effort);
            // Efforts that are computed from goals are in no message.
            if !is_told && !self.is_effort_computed {
                impossible.push((Channel::Effort, lost_efforts(joint, &channels.effort)));
            }
            for (channel, found) in impossible {
                let Some(first) = found.first() else { continue };
                let (row, count) = (table.row(first.sample), found.len());
                let source = sources.iter().find(|(c, _)| *c == channel);
                let column = source.map_or_else(
                    || format!("{}.{} (of effort_source)", joint.name, channel.suffix()),
                    |(_, source)| source.column.clone(),
                );
                let value = channels.get(channel).map_or(f64::NAN, |x| x[first.sample]);
                let expectation = first.expectation.clone();
                if count > most_left_out(time.len()) {
                    self.check_degrees(joint, sources, &time, table, &channels)?;
                    let (path, rows) = (self.path.clone(), time.len());
                    let few = most_left_out(rows);
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
                mended.push(Repair::LeftOut { column, row, found: value, expectation, count });
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

    /// Removes full turns from the position of a rotation that jumps by them.
    pub(crate) fn unwrap(
        &self,
        sources: &[(Channel, Source)],
        time: &[f64],
        table: &Table,
        channels: &mut Channels,
    ) -> Vec<Repair> {
        let mut mended = Vec::new();
        for (channel, source) in sources.iter().filter(|(c, _)| *c == Channel::Position) {
            let Some(found) = unwrap_turns(time, &channels.position) else { continue };
            let (row, count) = (table.row(found.jumps[0]), found.jumps.len());
            channels.set(*channel, found.position);
            mended.push(Repair::Turns { column: source.column.clone(), row, count });
        }
        mended
    }

    /// Refuses positions that look like degrees, unless the column map states their unit.
    pub(crate) fn check_degrees(
        &self,
        joint: &Joint,
        sources: &[(Channel, Source)],
        time: &[f64],
        table: &Table,
        channels: &Channels,
    ) -> Result<(), LogError> {
        let source_without_unit = |channel: Channel| {
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
        if let Some(source) = source_without_unit(Channel::Position)
            && let Some(expectation) = degrees::evidence(joint, time, channels)
        {
            return Err(looks(source, &channels.position, expectation));
        }
        if let Some(source) = source_without_unit(Channel::LinkPosition)
            && let Some(link) = &channels.link_position
            && let Some(expectation) = degrees::link_evidence(joint, &channels.position, link)
        {
            return Err(looks(source, link, expectation));
        }
        Ok(())
    }
}
