use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::Mutex;

use logs::{ColumnMap, Excerpt, LogError, ReadOptions, Recognised, Run};
use robot::Robot;

use crate::error::CliError;
use crate::input::seconds;
use crate::output::warn;

/// How the columns of logs are called.
#[derive(Debug, clap::Args)]
pub struct ColumnArguments {
    /// Names and units of columns that are called otherwise: a file (TOML), or ur, franka,
    /// plotjuggler or numpy for what these programs write
    #[arg(long, value_name = "FILE|NAME")]
    pub map: Option<PathBuf>,
    /// The effort is read from the columns `<joint>.COLUMN`
    #[arg(long, value_name = "COLUMN", default_value = "effort")]
    pub effort: String,
    /// The topic of a bag whose joint states are read [default: /joint_states, or the only one]
    #[arg(long, value_name = "NAME")]
    pub topic: Option<String>,
    /// Read a damaged log up to where it is damaged, and say where; without it, it is refused
    #[arg(long)]
    pub until_damage: bool,
    /// Which part of each log is read
    #[command(flatten)]
    pub excerpt: ExcerptArguments,
}

/// Which part of each log is read.
#[derive(Debug, Clone, Copy, Default, clap::Args)]
pub struct ExcerptArguments {
    /// Read every log from so many seconds after its first row on
    #[arg(long, value_name = "S", value_parser = seconds, allow_negative_numbers = true)]
    pub from_s: Option<f64>,
    /// Read every log up to so many seconds after its first row
    #[arg(long, value_name = "S", value_parser = seconds, allow_negative_numbers = true)]
    pub to_s: Option<f64>,
}

impl ExcerptArguments {
    /// What of a log is read, where that is not the whole.
    fn excerpt(self) -> Option<Excerpt> {
        let Self { from_s, to_s } = self;
        from_s.or(to_s)?;
        Some(Excerpt { from_s: from_s.unwrap_or(0.0), to_s: to_s.unwrap_or(f64::INFINITY) })
    }
}

impl ColumnArguments {
    /// The runs of some files.
    ///
    /// # Errors
    ///
    /// [`CliError::Log`] of the first file that cannot be used, or of the map.
    pub fn read_runs(&self, paths: &[PathBuf], robot: &Robot) -> Result<Vec<Run>, CliError> {
        let reader = self.reader()?;
        paths.iter().map(|path| reader.read(path, robot)).collect()
    }

    /// The file of the map, if it is one.
    pub fn map_file(&self) -> Option<&Path> {
        self.map.as_deref().filter(|_| self.preset().is_none())
    }

    /// What reads the logs; the file of a map is read once for all of them.
    pub fn reader(&self) -> Result<Reader<'_>, CliError> {
        let map = self.map_file().map(ColumnMap::load).transpose()?;
        Ok(Reader { arguments: self, map, told: Mutex::default() })
    }

    /// The preset that is asked for by name; a file of that name counts more.
    fn preset(&self) -> Option<&'static str> {
        let path = self.map.as_deref().filter(|path| !path.exists())?;
        logs::preset_names().into_iter().find(|name| path.as_os_str() == *name)
    }
}

/// Reads logs whose columns are called alike.
pub struct Reader<'a> {
    arguments: &'a ColumnArguments,
    map: Option<ColumnMap>,
    /// What was said of maps that were recognised; once is enough.
    told: Mutex<BTreeSet<String>>,
}

impl Reader<'_> {
    /// How a log is read with the map of a file, or without one.
    pub fn options(&self) -> ReadOptions<'_> {
        let ColumnArguments { effort, topic, excerpt, .. } = self.arguments;
        let (topic, excerpt) = (topic.as_deref(), excerpt.excerpt());
        ReadOptions { map: self.map.as_ref(), effort, topic, excerpt }
    }

    /// The run of a file.
    ///
    /// Where the usual columns are not there and those of a program that is known are, these are
    /// read, and said.
    pub fn read(&self, path: &Path, robot: &Robot) -> Result<Run, CliError> {
        let topic = self.arguments.topic.as_deref();
        if let Some(name) = self.arguments.preset() {
            let Some(found) = logs::recognised(path, robot, Some(name), topic)? else {
                return Ok(self.read_with(path, robot, &self.options())?);
            };
            return self.read_as(path, robot, &found);
        }
        let error = match self.read_with(path, robot, &self.options()) {
            Ok(run) => return Ok(run),
            Err(error) => error,
        };
        let is_named = matches!(error, LogError::JointAbsent { .. } | LogError::NoColumn { .. });
        if self.map.is_some() || !is_named {
            return Err(error.into());
        }
        match logs::recognised(path, robot, None, topic)? {
            Some(found) => {
                self.tell(&found);
                self.read_as(path, robot, &found)
            }
            None => Err(error.into()),
        }
    }

    fn read_as(&self, path: &Path, robot: &Robot, found: &Recognised) -> Result<Run, CliError> {
        let options = ReadOptions { map: Some(&found.map), ..self.options() };
        Ok(self.read_with(path, robot, &options)?)
    }

    /// The run, or what of it lies before the damage.
    fn read_with(
        &self,
        path: &Path,
        robot: &Robot,
        options: &ReadOptions,
    ) -> Result<Run, LogError> {
        if !self.arguments.until_damage {
            return logs::read_run(path, robot, options);
        }
        let (run, damage) = logs::read_run_until_damage(path, robot, options)?;
        if let Some(damage) = damage {
            warn(&format!("{damage}; {} rows before it are read", run.time.len()));
        }
        Ok(run)
    }

    fn tell(&self, found: &Recognised) {
        let note = format!("columns are read as --map {}: {}", found.name, found.words);
        let is_new = self.told.lock().is_ok_and(|mut told| told.insert(note.clone()));
        if is_new {
            anstream::eprintln!("note: {note}");
        }
    }
}
