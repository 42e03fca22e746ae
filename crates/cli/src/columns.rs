use std::collections::BTreeSet;
use std::ops::RangeInclusive;
use std::path::{Path, PathBuf};
use std::sync::Mutex;

use logs::{
    ColumnMap, ENOUGH_SAMPLES, Excerpt, FormatError, LerobotDataset, LogError, ReadOptions,
    Recognised, Repair, Run, thin_out,
};
use robot::Robot;

use crate::error::CliError;
use crate::input::seconds;
use crate::input_warnings::memory_need_gb;
use crate::messages::{note, warn};

/// What these options stand below in a help text.
const HEADING: &str = "How logs are read";

/// How the columns of logs are called.
#[derive(Debug, Clone, clap::Args)]
pub struct ColumnArguments {
    /// Names and units of columns that are called otherwise: a file (TOML), or ur, franka,
    /// plotjuggler, lerobot, rostopic or numpy for what these programs write
    #[arg(long, help_heading = HEADING, value_name = "FILE|NAME")]
    pub map: Option<PathBuf>,
    /// The effort is read from the columns `<joint>.COLUMN` [default: effort]
    #[arg(long, help_heading = HEADING, value_name = "COLUMN")]
    pub effort: Option<String>,
    /// The topic of a bag whose joint states are read [default: /joint_states, or the only one]
    #[arg(long, help_heading = HEADING, value_name = "NAME")]
    pub topic: Option<String>,
    /// Episodes of a dataset of LeRobot, such as 0-4,7; each is a run [default: all]
    #[arg(long, help_heading = HEADING, value_name = "LIST", value_delimiter = ',', value_parser = episodes)]
    pub episodes: Vec<RangeInclusive<u64>>,
    /// Read a damaged log up to where it is damaged, and say where; without it, it is refused
    #[arg(long, help_heading = HEADING)]
    pub until_damage: bool,
    /// Which part of each log is read
    #[command(flatten)]
    pub excerpt: ExcerptArguments,
}

/// Which part of each log is read.
#[derive(Debug, Clone, Copy, Default, clap::Args)]
pub struct ExcerptArguments {
    /// Read every log from so many seconds after its first row on
    #[arg(long, help_heading = HEADING, value_name = "S", value_parser = seconds, allow_negative_numbers = true)]
    pub from_s: Option<f64>,
    /// Read every log up to so many seconds after its first row
    #[arg(long, help_heading = HEADING, value_name = "S", value_parser = seconds, allow_negative_numbers = true)]
    pub to_s: Option<f64>,
}

impl ExcerptArguments {
    /// The part of a log that is read; none for the whole log.
    fn excerpt(self) -> Option<Excerpt> {
        let Self { from_s, to_s } = self;
        from_s.or(to_s)?;
        Some(Excerpt { from_s: from_s.unwrap_or(0.0), to_s: to_s.unwrap_or(f64::INFINITY) })
    }
}

/// How much of long logs takes part.
#[derive(Debug, Clone, Copy, Default, clap::Args)]
pub struct LengthArguments {
    /// All samples take part, and memory grows with them; without it, of logs that are together longer than 20
    /// minutes of seven joints at 500 Hz as much as that does, in stretches of a minute that are spread evenly
    #[arg(long, help_heading = HEADING)]
    pub all_samples: bool,
}

/// How the logs of a command are read.
#[derive(Debug, Clone, clap::Args)]
pub struct LogArguments {
    /// How their columns are called
    #[command(flatten)]
    pub columns: ColumnArguments,
    /// How much of them takes part
    #[command(flatten)]
    pub length: LengthArguments,
}

impl LogArguments {
    /// The runs of some files, or the part of them that is used.
    ///
    /// # Errors
    ///
    /// [`CliError::Log`] of the first file that cannot be used, or of the map.
    pub fn read_runs(&self, paths: &[PathBuf], robot: &Robot) -> Result<Vec<Run>, CliError> {
        let reader = self.columns.reader()?;
        let mut runs = Vec::new();
        for path in paths {
            let selected = self.columns.episodes_of(path)?;
            for episode in selected.iter() {
                runs.push(reader.read(path, episode, robot)?);
            }
        }
        let most = if self.length.all_samples { usize::MAX } else { ENOUGH_SAMPLES };
        let runs = thin_out(runs, most);
        if let Some(taken) =
            runs.iter().flat_map(|run| &run.mended).find_map(Repair::share_in_words)
        {
            note(&format_args!("{taken}; that needs about {} GB of memory", memory_need_gb(&runs)));
        }
        Ok(runs)
    }

    /// The file of the map, if it is one.
    pub fn map_file(&self) -> Option<&Path> {
        self.columns.map_file()
    }
}

impl ColumnArguments {
    /// The runs at a path: the selected episodes of a LeRobot dataset, or the one run of any other
    /// log.
    ///
    /// # Errors
    ///
    /// [`CliError::Log`], and [`CliError::NoEpisode`] where episodes are asked for that are not there.
    pub fn episodes_of(&self, path: &Path) -> Result<SelectedRuns, CliError> {
        let dataset = LerobotDataset::open(path).map_err(LogError::from)?;
        let all = dataset.as_ref().map_or_else(
            || vec![None],
            |dataset| dataset.episodes().into_iter().map(Some).collect(),
        );
        if self.episodes.is_empty() {
            return Ok(SelectedRuns { dataset, numbers: all });
        }
        let is_asked = |episode: u64| self.episodes.iter().any(|range| range.contains(&episode));
        let numbers: Vec<_> = all.into_iter().filter(|e| e.is_some_and(is_asked)).collect();
        if numbers.is_empty() {
            return Err(CliError::NoEpisode { path: path.to_owned() });
        }
        Ok(SelectedRuns { dataset, numbers })
    }

    /// The file of the map, if it is one.
    pub fn map_file(&self) -> Option<&Path> {
        self.map.as_deref().filter(|_| self.preset().is_none())
    }

    /// What reads the logs; the file of a map is read once for all of them.
    pub fn reader(&self) -> Result<Reader<'_>, CliError> {
        let map = self.map_file().map(ColumnMap::load).transpose()?;
        Ok(Reader { arguments: self, map, notes: Mutex::default() })
    }

    /// The preset of the given name, unless a file has that name.
    pub fn preset(&self) -> Option<&'static str> {
        let path = self.map.as_deref().filter(|path| !path.exists())?;
        logs::preset_names().into_iter().find(|name| path.as_os_str() == *name)
    }
}

/// The runs at a path that are asked for.
pub struct SelectedRuns {
    dataset: Option<LerobotDataset>,
    /// The episode that each run is; none of a log that is no dataset.
    numbers: Vec<Option<u64>>,
}

/// One run at a path.
#[derive(Clone, Copy, Default)]
pub struct RunAtPath<'a> {
    /// Its number; none of a log that is no dataset.
    pub number: Option<u64>,
    /// The dataset that has it, where it is opened.
    dataset: Option<&'a LerobotDataset>,
}

impl SelectedRuns {
    /// The runs in their order.
    pub fn iter(&self) -> impl Iterator<Item = RunAtPath<'_>> {
        let dataset = self.dataset.as_ref();
        self.numbers.iter().map(move |&number| RunAtPath { number, dataset })
    }
}

/// Reads logs with the same names of columns.
pub struct Reader<'a> {
    arguments: &'a ColumnArguments,
    map: Option<ColumnMap>,
    /// Notes about recognised maps that were printed, each once.
    notes: Mutex<BTreeSet<String>>,
}

impl Reader<'_> {
    /// How a log, or an episode of a dataset, is read with the map of a file, or without one.
    pub fn options<'a>(&'a self, episode: RunAtPath<'a>) -> ReadOptions<'a> {
        let ColumnArguments { effort, topic, excerpt, .. } = self.arguments;
        let effort = effort.as_deref().unwrap_or(ReadOptions::default().effort);
        let (topic, excerpt) = (topic.as_deref(), excerpt.excerpt());
        let RunAtPath { number, dataset } = episode;
        ReadOptions {
            map: self.map.as_ref(),
            effort,
            topic,
            excerpt,
            episode: number,
            dataset,
            ..ReadOptions::default()
        }
    }

    /// The run of a file, or of an episode of a dataset.
    ///
    /// Where the usual columns are absent, those of a known program are read, and a note says so.
    pub fn read(
        &self,
        path: &Path,
        episode: RunAtPath<'_>,
        robot: &Robot,
    ) -> Result<Run, CliError> {
        let options = self.options(episode);
        if let Some(name) = self.arguments.preset() {
            let Some(found) = logs::recognise(path, robot, Some(name), &options)? else {
                return Ok(self.read_with(path, robot, &options)?);
            };
            return self.read_as(path, robot, &options, &found);
        }
        let error = match self.read_with(path, robot, &options) {
            Ok(run) => return Ok(run),
            Err(error) => error,
        };
        let is_named = matches!(
            error,
            LogError::JointAbsent { .. }
                | LogError::EffortAbsent { .. }
                | LogError::File(FormatError::NoColumn { .. })
        );
        if self.map.is_some() || !is_named {
            return Err(error.into());
        }
        match logs::recognise(path, robot, None, &options)? {
            Some(found) => {
                self.tell(&found);
                self.read_as(path, robot, &options, &found)
            }
            None => Err(error.into()),
        }
    }

    fn read_as(
        &self,
        path: &Path,
        robot: &Robot,
        options: &ReadOptions,
        found: &Recognised,
    ) -> Result<Run, CliError> {
        let options = ReadOptions { map: Some(&found.map), ..*options };
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
        let words = format!("columns are read as --map {}: {}", found.name, found.words);
        let is_new = self.notes.lock().is_ok_and(|mut notes| notes.insert(words.clone()));
        if is_new {
            note(&words);
        }
    }
}

/// Episodes of an option: one, or those from one to another.
fn episodes(text: &str) -> Result<RangeInclusive<u64>, String> {
    let (first, last) = text.split_once('-').unwrap_or((text, text));
    let number = |text: &str| text.trim().parse::<u64>().ok();
    let range = number(first).zip(number(last)).filter(|(first, last)| first <= last);
    let (first, last) = range.ok_or("a number or FIRST-LAST was expected")?;
    Ok(first..=last)
}
