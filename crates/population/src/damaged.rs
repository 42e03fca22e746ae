use std::path::{Path, PathBuf};

use logs::{ReadOptions, Run};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use robot::Robot;

use crate::error::PopulationError;
use crate::log_kind::LogKind;
use crate::robot_files::RobotFiles;
use crate::sheet::LogSpoiling;
use crate::trial::make::write_runs;
use crate::trial::spoilt::log_damage::LogDamage;

/// A kind and a size by which the logs of a trial are to be spoilt, and the seed of what is drawn of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LogDamageSpec {
    /// The kind.
    pub kind: LogKind,
    /// Its size, as [`LogKind`] says.
    pub size: f64,
    /// Decides joint and rows.
    pub seed: u64,
}

/// Writes nominal model and logs of a trial, which [`make`](crate::make) has made in `from`, into `to` with damage of
/// this kind and size. Returns what was done; `None` where arm or logs cannot have it, and nothing is then written.
///
/// # Errors
///
/// [`PopulationError`] when the trial cannot be read or a file cannot be written.
pub fn damage_logs(
    from: &Path,
    damage: &LogDamageSpec,
    to: &Path,
) -> Result<Option<LogSpoiling>, PopulationError> {
    let truth = Robot::load(&from.join("truth").join("robot.toml"))?.robot;
    let mut runs = read_runs(&from.join("logs"), &truth)?;
    let mut random = ChaCha8Rng::seed_from_u64(damage.seed);
    let arm = (&truth, runs.len());
    let Some(drawn) = LogDamage::of_kind(damage.kind, Some(damage.size), arm, &mut random) else {
        return Ok(None);
    };
    let nominal = from.join("nominal");
    let unreadable = || std::io::Error::from(std::io::ErrorKind::NotFound);
    let files = RobotFiles::read(&nominal)
        .ok_or_else(|| PopulationError::of_folder(&nominal)(unreadable()))?;
    drawn.spoil(&truth, &mut runs);
    let files = drawn.describe(&files, &files.load()?, &runs)?.unwrap_or(files);
    let folder = to.join("nominal");
    std::fs::create_dir_all(&folder).map_err(PopulationError::of_folder(&folder))?;
    files.write(&folder)?;
    write_runs(&to.join("logs"), &runs)?;
    Ok(Some(drawn.spoiling(&truth)))
}

/// The logs of a folder, in the order of their names.
fn read_runs(folder: &Path, robot: &Robot) -> Result<Vec<Run>, PopulationError> {
    let at = PopulationError::of_folder(folder);
    let entries = std::fs::read_dir(folder).map_err(&at)?.map(|entry| entry.map(|e| e.path()));
    let mut paths: Vec<PathBuf> = entries.collect::<Result<_, _>>().map_err(&at)?;
    paths.sort();
    let read = |path: &PathBuf| Ok(logs::read_run(path, robot, &ReadOptions::default())?);
    paths.iter().map(read).collect()
}
