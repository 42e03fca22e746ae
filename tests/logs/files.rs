//! Writing and reading back, types of columns, column maps.

use std::{fs::File, sync::Arc};

use arrow_array::{ArrayRef, Float32Array, Float64Array, Int64Array, RecordBatch, StringArray};
use logs::{ColumnMap, LogError, ReadOptions, Run, read_run, write_csv, write_parquet};
use parquet::arrow::ArrowWriter;
use robot::JointKind;

use crate::support::{Scratch, clock, follows, robot, run, two_joints};

fn awkward() -> Run {
    let time = clock(300, 1000.0);
    let mut j1 = follows("j1", &time, |t| (1.0 / 3.0 + t).sin());
    let j2 = follows("j2", &time, |t| 1e-300 * t - 0.0);
    j1.velocity = Some(time.iter().map(|t| 0.1 + 0.2 * t).collect());
    j1.acceleration = Some(time.iter().map(|t| 1e17 * t).collect());
    j1.desired_position = Some(time.iter().map(|t| -t).collect());
    j1.desired_velocity = Some(time.iter().map(|t| 5e-324 * t.ceil()).collect());
    j1.desired_acceleration = Some(vec![f64::MAX; 300]);
    j1.commanded_effort = Some(time.iter().map(|t| t / 7.0).collect());
    j1.link_position = Some(time.iter().map(|t| (t / 3.0).cos()).collect());
    let mut run = run(time.clone(), vec![j1, j2]);
    run.extra.insert("j1.temperature".to_owned(), time.iter().map(|t| 20.0 + t).collect());
    run
}

#[test]
fn parquet_and_csv_read_back_exactly() {
    for name in ["run.parquet", "run.csv"] {
        let file = Scratch::new(name, "replaced");
        let written = awkward();
        match name {
            "run.csv" => write_csv(&file.path, &written).unwrap(),
            _ => write_parquet(&file.path, &written).unwrap(),
        }
        let read = file.read(&two_joints()).unwrap();
        assert_eq!(read.sha256.len(), 64);
        let (source, sha256) = (file.path.clone(), read.sha256.clone());
        assert_eq!(read, Run { source, sha256, ..written }, "{name}");
        let files = std::fs::read_dir(file.folder.path()).unwrap().count();
        assert_eq!(files, 1, "no temporary file is left");
    }
}

#[test]
fn sha256_is_that_of_the_file() {
    let file = Scratch::new("run.csv", "time,a.position,a.effort\n0,1,2\n1,1,2\n");
    let read = file.read(&robot(&[("a", JointKind::Revolute)])).unwrap();
    // sha256sum of the same bytes.
    let expected = "7533ad879c34cb449a94376f0afbd9658a57e1ab095612ee0f6ad9a658cb9b08";
    assert_eq!(read.sha256, expected);
}

#[test]
fn a_file_that_cannot_be_written_is_an_error() {
    let file = Scratch::new("x", "");
    let path = file.folder.path().join("missing/run.csv");
    let error = write_csv(&path, &awkward()).unwrap_err();
    assert!(matches!(error, LogError::Unwritable { path: p, .. } if p == path));
}

#[test]
fn joints_are_matched_by_name_in_any_order() {
    let content =
        "j2.effort,note,j2.position,time,j1.effort,j1.position\n4,a,3,0,2,1\n4,b,3,1,2,1\n";
    let file = Scratch::new("run.csv", content);
    let read = file.read(&two_joints()).unwrap();
    assert_eq!(read.joints[0].name, "j1");
    assert_eq!((read.joints[0].position[0], read.joints[0].effort[0]), (1.0, 2.0));
    assert_eq!((read.joints[1].position[0], read.joints[1].effort[0]), (3.0, 4.0));
    assert!(read.extra.is_empty(), "a column of text is not kept");
}

#[test]
fn another_effort_can_be_asked_for() {
    let content = "time,j1.position,j1.effort,j1.effort_sensor\n0,1,2,3\n1,1,2,3\n";
    let file = Scratch::new("run.csv", content);
    let options = ReadOptions { effort: "effort_sensor", ..ReadOptions::default() };
    let read = read_run(&file.path, &robot(&[("j1", JointKind::Revolute)]), &options).unwrap();
    assert_eq!(read.joints[0].effort, [3.0, 3.0]);
    assert_eq!(read.extra["j1.effort"], [2.0, 2.0]);
}

fn parquet(columns: Vec<(&str, ArrayRef)>) -> Scratch {
    let file = Scratch::new("run.parquet", "");
    let nullable = columns.into_iter().map(|(name, array)| (name, array, true));
    let batch = RecordBatch::try_from_iter_with_nullable(nullable).unwrap();
    let target = File::create(&file.path).unwrap();
    let mut writer = ArrowWriter::try_new(target, batch.schema(), None).unwrap();
    writer.write(&batch).unwrap();
    writer.close().unwrap();
    file
}

#[test]
fn parquet_integers_and_singles_are_converted() {
    let file = parquet(vec![
        ("time", Arc::new(Int64Array::from(vec![0, 1, 2]))),
        ("j1.position", Arc::new(Float32Array::from(vec![0.5, 1.5, 2.5]))),
        ("j1.effort", Arc::new(Float64Array::from(vec![1.0, 2.0, 3.0]))),
        ("mode", Arc::new(StringArray::from(vec!["a", "b", "c"]))),
    ]);
    let read = file.read(&robot(&[("j1", JointKind::Revolute)])).unwrap();
    assert_eq!(read.time, [0.0, 1.0, 2.0]);
    assert_eq!(read.joints[0].position, [0.5, 1.5, 2.5]);
    assert!(read.extra.is_empty());
}

#[test]
fn parquet_nulls_and_text_are_refused() {
    let arm = robot(&[("j1", JointKind::Revolute)]);
    let effort: ArrayRef = Arc::new(Float64Array::from(vec![1.0, 2.0]));
    let file = parquet(vec![
        ("time", Arc::new(Int64Array::from(vec![0, 1]))),
        ("j1.position", Arc::new(Float64Array::from(vec![Some(1.0), None]))),
        ("j1.effort", effort.clone()),
    ]);
    assert_eq!(
        file.message(&arm),
        "run.parquet: row 2, column j1.position: the value is missing, a number was expected"
    );
    let file = parquet(vec![
        ("time", Arc::new(Int64Array::from(vec![0, 1]))),
        ("j1.position", Arc::new(StringArray::from(vec!["1", "2"]))),
        ("j1.effort", effort),
    ]);
    assert_eq!(
        file.message(&arm),
        "run.parquet: column j1.position holds Utf8, numbers were expected"
    );
}

#[test]
fn a_column_map_converts_names_and_units() {
    let text = r#"
        time = { column = "t_ns", unit = "ns" }
        [joint.j1]
        position = { column = "q0", unit = "deg", scale = -1.0, offset = 0.5 }
        effort = { column = "i0", unit = "raw", scale = 0.1 }
        link_position = { column = "link", unit = "rev" }
        [joint.rail]
        position = { column = "x", unit = "mm" }
        effort = { column = "f", unit = "N" }
    "#;
    let map = Scratch::new("map.toml", text);
    let map = ColumnMap::load(&map.path).unwrap();
    let content = "t_ns,q0,i0,x,f,j1.velocity,link\n\
                   1000000000,180,20,1500,7,1,0.25\n2000000000,0,10,0,7,1,0\n";
    let file = Scratch::new("run.csv", content);
    let arm = robot(&[("j1", JointKind::Revolute), ("rail", JointKind::Prismatic)]);
    let options = ReadOptions { map: Some(&map), ..ReadOptions::default() };
    let read = read_run(&file.path, &arm, &options).unwrap();
    assert_eq!(read.time, [1.0, 2.0]);
    assert!((read.joints[0].position[0] - (0.5 - std::f64::consts::PI)).abs() < 1e-15);
    assert_eq!(read.joints[0].effort, [2.0, 1.0]);
    assert_eq!(read.joints[0].velocity, Some(vec![1.0, 1.0]), "usual names still work");
    assert_eq!(read.joints[0].link_position, Some(vec![std::f64::consts::FRAC_PI_2, 0.0]));
    assert_eq!(read.joints[1].position, [1.5, 0.0]);
    assert!(read.extra.is_empty());
}
