//! Datasets of LeRobot, as that library lays them out.

use std::fs::{self, File};
use std::path::Path;
use std::sync::Arc;

use arrow_array::types::Float64Type;
use arrow_array::{ArrayRef, FixedSizeListArray, Float64Array, Int64Array, ListArray, RecordBatch};
use logs::{Channel, Run};
use parquet::arrow::ArrowWriter;
use serde_json::{Value, json};

/// A layout of a dataset.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Layout {
    /// Version 2.1: a file an episode, lists of a fixed size.
    FileAnEpisode,
    /// Version 3.0: all episodes in one file, lists of any size.
    OneFile,
}

/// The columns of lists, by the channel that they hold.
const LISTS: [(&str, Channel); 4] = [
    ("observation.state", Channel::Position),
    ("observation.velocity", Channel::Velocity),
    ("observation.effort", Channel::Effort),
    ("action", Channel::DesiredPosition),
];

/// Writes runs as the episodes of a dataset, joints named `<joint>.pos` in `meta/info.json`; what the
/// first run has not is left out, and so is `without`.
pub fn write(folder: &Path, runs: &[Run], layout: Layout, without: &[Channel]) {
    let has = |channel| !without.contains(&channel) && runs[0].joints[0].get(channel).is_some();
    let lists: Vec<(&str, Channel)> = LISTS.into_iter().filter(|(_, c)| has(*c)).collect();
    let names: Vec<String> = runs[0].joints.iter().map(|j| format!("{}.pos", j.name)).collect();
    let (version, data_path) = match layout {
        Layout::FileAnEpisode => {
            ("v2.1", "data/chunk-{episode_chunk:03d}/episode_{episode_index:06d}.parquet")
        }
        Layout::OneFile => ("v3.0", "data/chunk-{chunk_index:03d}/file-{file_index:03d}.parquet"),
    };
    let feature = |names: Value, count: usize| json!({ "dtype": "float64", "shape": [count], "names": names });
    let mut features = serde_json::Map::new();
    for (name, _) in &lists {
        features.insert((*name).to_owned(), feature(json!(names), names.len()));
    }
    features.insert("timestamp".to_owned(), feature(Value::Null, 1));
    features.insert("episode_index".to_owned(), feature(Value::Null, 1));
    let info = json!({ "codebase_version": version, "data_path": data_path, "features": features });
    fs::create_dir_all(folder.join("meta")).unwrap();
    fs::write(folder.join("meta/info.json"), info.to_string()).unwrap();
    fs::create_dir_all(folder.join("data/chunk-000")).unwrap();
    let batches = runs.iter().enumerate().map(|(k, run)| batch(run, k, &lists, layout));
    match layout {
        Layout::FileAnEpisode => {
            for (k, batch) in batches.enumerate() {
                let name = format!("data/chunk-000/episode_{k:06}.parquet");
                write_batches(&folder.join(name), &[batch]);
            }
        }
        Layout::OneFile => {
            let all: Vec<RecordBatch> = batches.collect();
            write_batches(&folder.join("data/chunk-000/file-000.parquet"), &all);
        }
    }
}

fn batch(run: &Run, episode: usize, lists: &[(&str, Channel)], layout: Layout) -> RecordBatch {
    let mut columns: Vec<(&str, ArrayRef)> = Vec::new();
    for (name, channel) in lists {
        let row = |k: usize| {
            let of = |joint: &logs::Channels| joint.get(*channel).map(|samples| samples[k]);
            Some(run.joints.iter().map(of).collect::<Vec<_>>())
        };
        let rows = (0..run.time.len()).map(row);
        let count = i32::try_from(run.joints.len()).unwrap();
        let array: ArrayRef = match layout {
            Layout::FileAnEpisode => {
                Arc::new(FixedSizeListArray::from_iter_primitive::<Float64Type, _, _>(rows, count))
            }
            Layout::OneFile => Arc::new(ListArray::from_iter_primitive::<Float64Type, _, _>(rows)),
        };
        columns.push((name, array));
    }
    let episode = i64::try_from(episode).unwrap();
    columns.push(("timestamp", Arc::new(Float64Array::from(run.time.clone()))));
    columns.push(("episode_index", Arc::new(Int64Array::from(vec![episode; run.time.len()]))));
    RecordBatch::try_from_iter(columns).unwrap()
}

fn write_batches(path: &Path, batches: &[RecordBatch]) {
    let mut writer =
        ArrowWriter::try_new(File::create(path).unwrap(), batches[0].schema(), None).unwrap();
    batches.iter().for_each(|batch| writer.write(batch).unwrap());
    writer.close().unwrap();
}
