use std::collections::BTreeMap;
use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime};

use exchange::{Format, export};
use population::{PopulationError, PopulationSpec, count_recorded_splits, make_recorded_split};
use rayon::iter::{IntoParallelIterator, ParallelIterator};
use rayon::{ThreadPool, ThreadPoolBuilder};
use robot::{Loaded, TorqueSource};

use crate::cause_bench::bench_set::BenchSet;
use crate::cause_bench::bench_truth::{BenchTruth, TrialTruth};
use crate::cause_bench::manifest::{BenchLog, BenchManifest, BenchTrial, MANIFEST_SCHEMA};
use crate::cause_bench::table_file::{NamedColumns, TIME, read};
use crate::error::BenchmarkError;
use crate::panel::population_trial::nominal;
use crate::statistics::median::median;
use crate::trial_folder::{HELD_OUT, LOGS, NOMINAL, log_files, unusable};

/// Time of every exported file (s of Unix time): the start of the year 2020 in UTC.
const FILE_TIME_S: u64 = 1_577_836_800;

/// File in a folder whose export has begun and not ended.
const BEGUN: &str = ".plumbline-export";

/// Channels of a held-out log. What a controller is told would tell its efforts, by its gains.
const HELD_OUT_CHANNELS: [&str; 2] = [".position", ".velocity"];

/// Ends of the names of columns.
const EFFORT: &str = ".effort";
const POSITION: &str = ".position";

/// Speed below which a joint stands or creeps (rad/s or m/s), as for the oracle of a trial.
const CREEP: f64 = 2e-3;

/// The same as a share of its largest speed.
const CREEP_SHARE: f64 = 0.02;

/// What is exported, and where to.
#[derive(Debug, Clone)]
pub struct ExportRequest {
    /// The set.
    pub set: BenchSet,
    /// Folder of recorded logs, for [`BenchSet::Recorded`].
    pub data: PathBuf,
    /// Seed of a set that nobody else can make; `None` for the public one.
    pub seed: Option<u64>,
    /// Most trials, the first ones; `None` for all.
    pub most: Option<usize>,
    /// Folder of the set, which is empty or absent.
    pub folder: PathBuf,
    /// File of the truth, outside that folder.
    pub truth: PathBuf,
    /// Trials made at a time.
    pub jobs: usize,
}

/// Makes the trials of a set and writes them without their truth, which goes into a file outside the folder.
///
/// ```text
/// seed of the set --population--> trial --\--> FOLDER/trial_NNN/{robot.urdf, robot.xml, robot.toml, logs/, held_out.*}
///                                          \--> TRUTH, whose SHA-256 FOLDER/manifest.json has
/// ```
///
/// The bytes follow from the set and its seed alone, for any number of jobs; every file has the same time.
/// `on_trial` is called after each trial.
///
/// # Errors
///
/// [`BenchmarkError`] for a folder that is not empty, a truth inside it, a trial that cannot be made, and a file that
/// cannot be written.
pub fn export_set(
    request: &ExportRequest,
    on_trial: &(dyn Fn() + Sync),
) -> Result<BenchManifest, BenchmarkError> {
    prepare(request)?;
    let made = make_set(request, on_trial);
    if made.is_err() {
        // What was begun is no set, and the folder was empty. What cannot be removed now is removed by the next export.
        let _ = clear(&request.folder);
    }
    made
}

/// Makes the trials, the truth, and the manifest last.
fn make_set(
    request: &ExportRequest,
    on_trial: &(dyn Fn() + Sync),
) -> Result<BenchManifest, BenchmarkError> {
    let spec = request.set.population();
    let all =
        spec.as_ref().map_or_else(|| count_recorded_splits(&request.data), |spec| spec.trials);
    if all == 0 {
        return Err(PopulationError::NoRecordedLogs { data: request.data.clone() }.into());
    }
    let count = request.most.map_or(all, |most| most.min(all));
    let made: Result<Vec<_>, BenchmarkError> = threads(request.jobs)?.install(|| {
        let make = |number| {
            let made = export_trial(request, spec.as_ref(), number);
            on_trial();
            made
        };
        (0..count).into_par_iter().map(make).collect()
    });
    let (trials, truths): (Vec<BenchTrial>, Vec<TrialTruth>) = made?.into_iter().unzip();
    let names = trials.iter().map(|trial| trial.name.clone());
    let (text, truth_sha256) = BenchTruth::new(names.zip(truths).collect()).seal(&request.truth)?;
    write(&request.truth, &text)?;
    let schema = MANIFEST_SCHEMA.to_owned();
    let manifest = BenchManifest { schema, set: request.set, truth_sha256, trials };
    let text = serde_json::to_string_pretty(&manifest).unwrap_or_default() + "\n";
    write(&request.folder.join(BenchManifest::FILE), &text)?;
    let begun = request.folder.join(BEGUN);
    fs::remove_file(&begun).map_err(unusable(&begun))?;
    set_times(&request.folder).map_err(unusable(&request.folder))?;
    Ok(manifest)
}

/// Removes all that is in the folder of a set whose export has begun, the file that says so last.
fn clear(folder: &Path) -> std::io::Result<()> {
    let begun = folder.join(BEGUN);
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        match path.is_dir() {
            true => fs::remove_dir_all(&path)?,
            false if path == begun => {}
            false => fs::remove_file(&path)?,
        }
    }
    match fs::remove_file(&begun) {
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => Ok(()),
        removed => removed,
    }
}

/// Refuses a folder with files in it, but for what an export that was killed left, which is removed, and a truth inside
/// of it; marks the folder as begun.
fn prepare(request: &ExportRequest) -> Result<(), BenchmarkError> {
    let folder = &request.folder;
    fs::create_dir_all(folder).map_err(unusable(folder))?;
    let refuse = |path: &Path, found: &str, expected| {
        let (path, found) = (path.to_owned(), found.to_owned());
        Err(BenchmarkError::UnusableBenchFile { path, found, expected })
    };
    let begun = folder.join(BEGUN);
    if begun.is_file() {
        clear(folder).map_err(unusable(folder))?;
    }
    if fs::read_dir(folder).map_err(unusable(folder))?.next().is_some() {
        return refuse(folder, "a folder with files in it", "an empty one");
    }
    let beside = request.truth.parent().filter(|beside| !beside.as_os_str().is_empty());
    if files::is_below(beside.unwrap_or(Path::new(".")), folder) {
        return refuse(&request.truth, "a file in the folder of the set", "one outside of it");
    }
    write(&begun, "plumbline-bench export\n")
}

fn threads(jobs: usize) -> Result<ThreadPool, BenchmarkError> {
    let pool = ThreadPoolBuilder::new().num_threads(jobs.max(1)).build();
    pool.map_err(|error| BenchmarkError::NoThreads { reason: error.to_string() })
}

/// Makes a trial in a folder of its own and writes what may be seen of it.
fn export_trial(
    request: &ExportRequest,
    spec: Option<&PopulationSpec>,
    number: usize,
) -> Result<(BenchTrial, TrialTruth), BenchmarkError> {
    let temporary = tempfile::tempdir().map_err(unusable(&std::env::temp_dir()))?;
    let made = temporary.path();
    let sheet = match spec {
        Some(spec) => population::make(spec, request.set.trial_seed(request.seed, number), made)?,
        None => make_recorded_split(&request.data, number, made)?,
    };
    let name = format!("trial_{:03}", number + 1);
    let folder = request.folder.join(&name);
    fs::create_dir_all(folder.join(LOGS)).map_err(unusable(&folder))?;
    let out = Exported { root: &request.folder, trial: &name };
    let described = nominal(made)?;
    let mut logs = Vec::new();
    for (k, path) in log_files(&made.join(LOGS))?.iter().enumerate() {
        logs.push(out.log(&format!("{LOGS}/log_{}", k + 1), read(path)?)?);
    }
    let held_out = log_files(&made.join(HELD_OUT))?;
    // Of recorded arms a part of every log is held out: each trial has another one.
    let columns = held_out
        .get(number % held_out.len().max(1))
        .map(|path| read(path))
        .transpose()?
        .unwrap_or_default();
    let held_out_effort = columns.iter().filter_map(effort).collect();
    let time = columns.iter().find(|(name, _)| name == TIME).map_or(&[][..], |(_, t)| t);
    let moving = columns.iter().filter_map(|(name, q)| {
        Some((name.strip_suffix(POSITION)?.to_owned(), moving_rows(time, q)))
    });
    let moving = moving.collect();
    let is_shown = |name: &str| name == TIME || HELD_OUT_CHANNELS.iter().any(|c| name.ends_with(c));
    let shown = columns.into_iter().filter(|(name, _)| is_shown(name)).collect();
    let held_out = out.log(HELD_OUT, shown)?;
    let trial = out.trial((&described, &made.join(NOMINAL)), logs, held_out)?;
    Ok((trial, TrialTruth { sheet, held_out_effort, moving }))
}

/// The joint and the samples of a column of efforts.
fn effort((name, samples): &(String, Vec<f64>)) -> Option<(String, Vec<f32>)> {
    let joint = name.strip_suffix(EFFORT)?;
    Some((joint.to_owned(), samples.iter().map(|x| *x as f32).collect()))
}

/// Stretches of rows in which a joint at `q` moves, by central differences.
fn moving_rows(time: &[f64], q: &[f64]) -> Vec<[usize; 2]> {
    let last = q.len().saturating_sub(1);
    let speed = |k: usize| {
        let [before, after] = [k.saturating_sub(1), (k + 1).min(last)];
        ((q[after] - q[before]) / (time[after] - time[before])).abs()
    };
    let speeds: Vec<f64> = (0..time.len().min(q.len())).map(speed).collect();
    let least = CREEP.max(CREEP_SHARE * speeds.iter().copied().fold(0.0, f64::max));
    let mut stretches: Vec<[usize; 2]> = Vec::new();
    for k in (0..speeds.len()).filter(|k| speeds[*k] > least) {
        match stretches.last_mut() {
            Some([_, end]) if *end == k => *end += 1,
            _ => stretches.push([k, k + 1]),
        }
    }
    stretches
}

/// The folder of a trial in that of a set.
struct Exported<'a> {
    root: &'a Path,
    trial: &'a str,
}

impl Exported<'_> {
    /// Writes columns as Parquet and as npz.
    fn log(&self, stem: &str, columns: NamedColumns) -> Result<BenchLog, BenchmarkError> {
        let named = |ending: &str| format!("{}/{stem}.{ending}", self.trial);
        let (parquet, npz) = (named("parquet"), named("npz"));
        logs::write_columns(&self.root.join(&parquet), &columns)?;
        logs::write_npz(&self.root.join(&npz), &columns)?;
        let time = columns.iter().find(|(name, _)| name == TIME).map_or(&[][..], |(_, t)| t);
        let steps = time.windows(2).map(|pair| pair[1] - pair[0]).collect();
        let rate_hz = median(steps).map(|step| 1.0 / step).filter(|rate| rate.is_finite());
        let mut channels = Vec::new();
        for (_, channel) in columns.iter().filter_map(|(name, _)| name.rsplit_once('.')) {
            if !channels.iter().any(|known| known == channel) {
                channels.push(channel.to_owned());
            }
        }
        Ok(BenchLog { parquet, npz, rows: time.len(), rate_hz, channels })
    }

    /// Writes the described arm and lists what the folder holds.
    fn trial(
        &self,
        (described, nominal): (&Loaded, &Path),
        logs: Vec<BenchLog>,
        held_out: BenchLog,
    ) -> Result<BenchTrial, BenchmarkError> {
        let named = |name: &str| format!("{}/{name}", self.trial);
        let (urdf, mjcf) = (named("robot.urdf"), named("robot.xml"));
        let description = named("robot.toml");
        let source = text(&nominal.join("robot.urdf"))?;
        write(&self.root.join(&urdf), &source)?;
        let model = export(described, &source, Format::Mjcf)?;
        write(&self.root.join(&mjcf), &model.text)?;
        write(&self.root.join(&description), &text(&nominal.join("robot.toml"))?)?;
        let links = described.robot.links();
        let source = |link: &robot::Link| source_name(link.actuator.torque_source).to_owned();
        Ok(BenchTrial {
            name: self.trial.to_owned(),
            urdf,
            mjcf,
            description,
            joints: described.robot.joint_names().map(str::to_owned).collect(),
            links: links.iter().map(|link| link.name.clone()).collect(),
            effort_source: links.iter().map(source).collect(),
            logs,
            held_out,
        })
    }
}

fn source_name(source: TorqueSource) -> &'static str {
    match source {
        TorqueSource::Measured => "measured",
        TorqueSource::Commanded => "commanded",
        TorqueSource::Current => "current",
        TorqueSource::Unknown => "unknown",
    }
}

fn text(path: &Path) -> Result<String, BenchmarkError> {
    files::text(path, files::KEPT_BYTES).map_err(|error| unusable(path)(error.into()))
}

fn write(path: &Path, text: &str) -> Result<(), BenchmarkError> {
    Ok(logs::replace_file(path, |file| Ok(std::io::Write::write_all(file, text.as_bytes())?))?)
}

/// Gives every file of a folder, and the folder, the same time.
fn set_times(folder: &Path) -> std::io::Result<()> {
    let time = SystemTime::UNIX_EPOCH + Duration::from_secs(FILE_TIME_S);
    let entries: BTreeMap<PathBuf, bool> = fs::read_dir(folder)?
        .map(|entry| entry.map(|entry| (entry.path(), entry.path().is_dir())))
        .collect::<Result<_, _>>()?;
    for (path, is_folder) in entries {
        if is_folder {
            set_times(&path)?;
        } else {
            File::options().append(true).open(&path)?.set_modified(time)?;
        }
    }
    // Some systems give a folder no other time; it says nothing of a trial then either.
    let _ = File::options().read(true).open(folder).and_then(|folder| folder.set_modified(time));
    Ok(())
}
