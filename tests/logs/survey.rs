//! The cut-off of every recorded log at hand, as a table.

use std::{
    fs::File,
    path::{Path, PathBuf},
};

use logs::{PrepareSettings, ReadOptions, Run, prepare, read_run};
use parquet::arrow::arrow_reader::ParquetRecordBatchReaderBuilder;
use robot::{JointKind, Robot};

use crate::support::{robot, root};

/// A robot with the joints of a file; their limits do not matter.
fn arm(file: &Path) -> Robot {
    let reader = ParquetRecordBatchReaderBuilder::try_new(File::open(file).unwrap()).unwrap();
    let columns = reader.schema().fields().iter().map(|field| field.name().clone());
    let mut names: Vec<String> =
        columns.filter_map(|c| c.strip_suffix(".position").map(str::to_owned)).collect();
    names.sort();
    let joints: Vec<_> = names.iter().map(|n| (n.as_str(), JointKind::Continuous)).collect();
    robot(&joints)
}

/// Whether a folder holds other things than runs of named joints: datasets of LeRobot, and files that are damaged on purpose.
fn is_left_out(folder: &Path) -> bool {
    folder.ends_with("faults") || folder.join("meta/info.json").is_file()
}

/// The logs under a folder, those of a folder together.
fn logs_under(folder: &Path) -> Vec<Vec<PathBuf>> {
    let mut inside: Vec<PathBuf> =
        folder.read_dir().into_iter().flatten().flatten().map(|entry| entry.path()).collect();
    inside.sort();
    let own = inside.iter().filter(|p| p.extension().is_some_and(|e| e == "parquet")).cloned();
    let mut all = vec![own.collect::<Vec<_>>()];
    let inner = inside.iter().filter(|path| path.is_dir() && !is_left_out(path));
    all.extend(inner.flat_map(|folder| logs_under(folder)));
    all.retain(|files| !files.is_empty());
    all
}

/// Prints the cut-off of every log and what it follows from. A pendulum with 2155 counts a turn swings
/// at 1 Hz; four dropouts of 5 to 9 ms are no borders at 1 kHz.
#[test]
fn recorded_cutoffs_follow_the_motion() {
    let folder = std::env::var_os("PLUMBLINE_DATA")
        .map_or_else(|| root().join("../shared/data"), PathBuf::from);
    for files in logs_under(&folder) {
        let arm = arm(&files[0]);
        let read = |file: &PathBuf| read_run(file, &arm, &ReadOptions::default()).unwrap();
        let runs: Vec<Run> = files.iter().map(read).collect();
        let name = files[0].parent().and_then(|p| p.strip_prefix(&folder).ok()).unwrap().display();
        let prepared = match prepare(&runs, &PrepareSettings::default()) {
            Ok(prepared) => prepared,
            Err(error) => {
                println!("{name} | {error}");
                continue;
            }
        };
        println!(
            "{name} | {} runs, {} pieces | {}",
            runs.len(),
            prepared.runs.len(),
            prepared.cutoff_reason
        );
        for (channels, noise) in runs[0].joints.iter().zip(&prepared.noise) {
            println!("    {}: {noise:?}", channels.name);
        }
    }
}
