//! Datasets of LeRobot, and Parquet files with columns of lists.

use std::fs::{self, File};
use std::path::Path;
use std::sync::Arc;

use arrow_array::types::Float32Type;
use arrow_array::{ArrayRef, Float64Array, ListArray, RecordBatch};
use checks::lerobot::{Layout, write};
use logs::{
    Channel, Channels, ColumnMap, FormatError, LerobotDataset, LogError, ReadOptions, Run,
    read_run, recognise,
};
use parquet::arrow::ArrowWriter;
use tempfile::TempDir;

use crate::support::{clock, follows, run, two_joints};

/// More than a batch of rows, so that lists are put together from several.
const ROWS: usize = 5000;

/// Two runs of two joints with goals, of different lengths.
fn runs() -> Vec<Run> {
    let of = |(count, shift): (usize, f64)| {
        let time = clock(count, 50.0);
        let joint = |name, slow: f64| {
            let goal: Vec<f64> = time.iter().map(|t| (slow * t + shift + 0.01).sin()).collect();
            let own = follows(name, &time, |t| (slow * t + shift).sin());
            Channels { desired_position: Some(goal), ..own }
        };
        let joints = vec![joint("j1", 1.0), joint("j2", 0.7)];
        run(time, joints)
    };
    [(ROWS, 0.0), (300, 1.0)].into_iter().map(of).collect()
}

fn dataset(layout: Layout, without: &[Channel]) -> TempDir {
    let folder = TempDir::new().unwrap();
    write(folder.path(), &runs(), layout, without);
    folder
}

fn read(path: &Path, name: Option<&str>, episode: Option<u64>) -> Result<Run, LogError> {
    let asked = ReadOptions { episode, ..ReadOptions::default() };
    let found = recognise(path, &two_joints(), name, &asked)?.map(|found| found.map);
    read_run(path, &two_joints(), &ReadOptions { map: found.as_ref(), ..asked })
}

/// Runs one after the other as a single one.
fn joined(runs: &[Run]) -> Run {
    let mut all = runs[0].clone();
    for next in &runs[1..] {
        for (joint, next) in all.joints.iter_mut().zip(&next.joints) {
            joint.position.extend(&next.position);
            joint.effort.extend(&next.effort);
            joint
                .desired_position
                .as_mut()
                .unwrap()
                .extend(next.desired_position.as_ref().unwrap());
        }
    }
    all.time = clock(all.joints[0].position.len(), 50.0);
    all
}

/// The episodes of the dataset in a folder.
fn episodes(path: &Path) -> Result<Vec<u64>, LogError> {
    Ok(LerobotDataset::open(path)?.unwrap().episodes())
}

#[test]
fn every_episode_is_a_run_with_the_joints_by_their_names() {
    for layout in [Layout::FileAnEpisode, Layout::OneFile] {
        let folder = dataset(layout, &[]);
        assert_eq!(episodes(folder.path()).unwrap(), [0, 1]);
        for (k, expected) in runs().iter().enumerate() {
            let run = read(folder.path(), None, Some(k as u64)).unwrap();
            assert_eq!((&run.time, &run.joints), (&expected.time, &expected.joints), "{layout:?}");
            assert!(run.name.ends_with(&format!("_episode_{k}")), "{}", run.name);
            assert!(!run.sha256.is_empty());
        }
    }
}

/// The column of episodes is other than it was when the dataset was opened, and is not looked at again.
#[test]
fn episodes_of_a_dataset_that_is_open_are_read_without_their_column() {
    let folder = dataset(Layout::OneFile, &[]);
    let opened = LerobotDataset::open(folder.path()).unwrap().unwrap();
    write(folder.path(), &[joined(&runs())], Layout::OneFile, &[]);
    assert_eq!(episodes(folder.path()).unwrap(), [0]);
    let map = recognise(folder.path(), &two_joints(), None, &ReadOptions::default()).unwrap();
    let map = map.map(|found| found.map);
    let options = ReadOptions { map: map.as_ref(), episode: Some(1), ..ReadOptions::default() };
    let known = ReadOptions { dataset: Some(&opened), ..options };
    let run = read_run(folder.path(), &two_joints(), &known).unwrap();
    assert_eq!(run.joints, runs()[1].joints);
    assert!(read_run(folder.path(), &two_joints(), &options).is_err());
    assert_eq!(LerobotDataset::open(&folder.path().join("data")).unwrap(), None);
}

/// Other names than those of the robot: the order of the joints counts where it is asked for.
#[test]
fn joints_without_a_name_are_read_in_their_order_by_the_preset_alone() {
    let folder = dataset(Layout::OneFile, &[]);
    let info = folder.path().join("meta/info.json");
    let text = fs::read_to_string(&info).unwrap();
    fs::write(&info, text.replace("[\"j1.pos\",\"j2.pos\"]", "{\"motors\":[\"a\",\"b\"]}"))
        .unwrap();
    assert!(matches!(read(folder.path(), None, Some(1)), Err(LogError::JointAbsent { .. })));
    let run = read(folder.path(), Some("lerobot"), Some(1)).unwrap();
    assert_eq!(run.joints, runs()[1].joints);
}

#[test]
fn names_in_a_table_and_with_the_prefix_of_older_datasets_are_those_of_joints() {
    let folder = dataset(Layout::FileAnEpisode, &[]);
    let info = folder.path().join("meta/info.json");
    let text = fs::read_to_string(&info).unwrap();
    let names = "{\"motors\":[\"main_j2\",\"main_j1\"]}";
    fs::write(&info, text.replace("[\"j1.pos\",\"j2.pos\"]", names)).unwrap();
    let run = read(folder.path(), None, Some(0)).unwrap();
    assert_eq!(run.joints[1].position, runs()[0].joints[0].position);
}

#[test]
fn an_episode_that_is_not_there_or_not_said_is_told() {
    let folder = dataset(Layout::OneFile, &[]);
    let told = |episode| {
        let options = ReadOptions { episode, ..ReadOptions::default() };
        let error = read_run(folder.path(), &two_joints(), &options).unwrap_err();
        error.to_string().replace(&folder.path().display().to_string(), "set")
    };
    assert_eq!(told(Some(7)), "set: there is no episode 7, it has 2 from 0 to 1");
    assert_eq!(told(None), "set: a run is one episode of the dataset, it has 2 from 0 to 1");
}

#[test]
fn a_damaged_dataset_is_refused_in_one_sentence() {
    let folder = dataset(Layout::OneFile, &[]);
    let file = folder.path().join("data/chunk-000/file-000.parquet");
    let bytes = fs::read(&file).unwrap();
    fs::write(&file, &bytes[..bytes.len() / 2]).unwrap();
    assert!(matches!(episodes(folder.path()), Err(LogError::File(FormatError::Broken { .. }))));
    fs::write(&file, "time,a\n0,1\n").unwrap();
    let told = episodes(folder.path()).unwrap_err().to_string();
    assert!(told.ends_with("in a dataset of LeRobot Parquet was expected"), "{told}");
    fs::write(&file, &bytes).unwrap();
    fs::write(folder.path().join("meta/info.json"), "{").unwrap();
    let told = read(folder.path(), Some("lerobot"), Some(0)).unwrap_err().to_string();
    assert!(told.contains("info.json: not a whole LeRobot file"), "{told}");
}

/// A Parquet file with the columns `time` and `q`, lists of these lengths.
fn lists(lengths: &[usize]) -> (TempDir, Result<Run, String>) {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("run.parquet");
    let row = |(k, length): (usize, &usize)| {
        Some((0..*length).map(|i| Some(0.25 * k as f32 + i as f32)).collect::<Vec<_>>())
    };
    let rows = lengths.iter().enumerate().map(row);
    let q: ArrayRef = Arc::new(ListArray::from_iter_primitive::<Float32Type, _, _>(rows));
    let time: ArrayRef = Arc::new(Float64Array::from(clock(lengths.len(), 100.0)));
    let batch = RecordBatch::try_from_iter([("time", time), ("q", q)]).unwrap();
    let mut writer =
        ArrowWriter::try_new(File::create(&path).unwrap(), batch.schema(), None).unwrap();
    writer.write(&batch).unwrap();
    writer.close().unwrap();
    let map = folder.path().join("map.toml");
    fs::write(&map, "position = \"q[:]\"\neffort = \"q[0:2]\"\n").unwrap();
    let map = ColumnMap::load(&map).unwrap();
    let options = ReadOptions { map: Some(&map), ..ReadOptions::default() };
    let run = read_run(&path, &two_joints(), &options).map_err(|error| error.to_string());
    (folder, run)
}

#[test]
fn a_column_of_lists_is_a_column_an_entry() {
    let run = lists(&[2, 2, 2]).1.unwrap();
    assert_eq!(run.joints[0].position, [0.0, 0.25, 0.5]);
    assert_eq!(run.joints[1].position, [1.0, 1.25, 1.5]);
}

#[test]
fn lists_of_different_lengths_are_refused() {
    let told = lists(&[2, 2, 3]).1.unwrap_err();
    assert!(
        told.ends_with("column q holds lists of 2 and of 3 numbers, numbers were expected"),
        "{told}"
    );
    let mut far = vec![2; ROWS];
    far[ROWS - 1] = 1;
    assert!(lists(&far).1.unwrap_err().contains("column q holds lists"));
    let mut later = vec![2; 4096];
    later.resize(ROWS, 3);
    let told = lists(&later).1.unwrap_err();
    assert!(told.contains("lists of different lengths"), "{told}");
}
