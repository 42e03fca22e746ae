use std::path::{Path, PathBuf};

use logs::{ReadOptions, Run};
use robot::Robot;
use simulator::LogFormat;

use crate::error::BenchmarkError;

/// Folders of a trial: its nominal model, the logs that are diagnosed, those that show a prediction, and the truth.
pub(crate) const NOMINAL: &str = "nominal";
pub(crate) const LOGS: &str = "logs";
pub(crate) const HELD_OUT: &str = "held_out";
pub(crate) const TRUTH: &str = "truth";

/// Reads every log of a trial's folder for this robot, in the order of their names.
pub(crate) fn read_runs(folder: &Path, robot: &Robot) -> Result<Vec<Run>, BenchmarkError> {
    let options = ReadOptions::default();
    let read = |path: &PathBuf| Ok(logs::read_run(path, robot, &options)?);
    log_files(folder)?.iter().map(read).collect()
}

/// The logs of a folder, in the order of their names.
pub(crate) fn log_files(folder: &Path) -> Result<Vec<PathBuf>, BenchmarkError> {
    let entries = std::fs::read_dir(folder).map_err(unusable(folder))?.map(|e| e.map(|e| e.path()));
    let mut paths = entries.collect::<Result<Vec<_>, _>>().map_err(unusable(folder))?;
    paths.retain(|path| path.extension().is_some_and(|e| e == LogFormat::Parquet.extension()));
    paths.sort();
    if paths.is_empty() {
        return Err(BenchmarkError::NoLogs { path: folder.to_owned() });
    }
    Ok(paths)
}

/// The error of a folder that cannot be listed, made or written.
pub(crate) fn unusable(folder: &Path) -> impl Fn(std::io::Error) -> BenchmarkError {
    |error| BenchmarkError::TrialFolder { path: folder.to_owned(), reason: error.to_string() }
}
