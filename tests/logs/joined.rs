//! Runs whose signals lie in a file each.

use std::path::{Path, PathBuf};

use logs::{ColumnMap, ReadOptions, Run, read_run, write_npz};

use crate::support::{Scratch, two_joints};

/// Two joints along `rows` rows of 100 Hz: time, positions, efforts.
fn signals(rows: usize) -> [Vec<f64>; 5] {
    let at = |of: fn(f64) -> f64| (0..rows).map(|k| of(0.01 * k as f64)).collect();
    [at(|t| t), at(|t| (2.0 * t).sin()), at(|t| 0.5 * t.cos()), at(|t| 3.0 * t.cos()), at(|t| -t)]
}

fn text(columns: &[&Vec<f64>]) -> String {
    let row = |k: usize| {
        let values: Vec<String> = columns.iter().map(|x| x[k].to_string()).collect();
        values.join(",") + "\n"
    };
    (0..columns[0].len()).map(row).collect()
}

fn write(folder: &Path, name: &str, text: &str) {
    std::fs::write(folder.join(name), text).unwrap();
}

fn map(text: &str) -> ColumnMap {
    ColumnMap::load(&Scratch::new("map.toml", text).path).unwrap()
}

/// Files without column names, and with: `q.csv`, `tau.csv`, `t.csv`, `named.csv`.
fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let [t, q1, q2, tau1, tau2] = &signals(300);
    write(folder.path(), "q.csv", &text(&[q1, q2]));
    write(folder.path(), "tau.csv", &text(&[tau1, tau2]));
    write(folder.path(), "t.csv", &text(&[t]));
    write(folder.path(), "named.csv", &format!("t,e1,e2\n{}", text(&[t, tau1, tau2])));
    folder
}

fn read(path: &Path) -> Result<Run, String> {
    let map = map("time = 't'\nposition = 'q[{i}]'\neffort = 'tau[{i}]'");
    let options = ReadOptions { map: Some(&map), ..ReadOptions::default() };
    read_run(path, &two_joints(), &options).map_err(|error| error.to_string())
}

fn assert_is_whole(run: &Run) {
    let [t, q1, q2, tau1, tau2] = signals(300);
    assert_eq!(run.time, t);
    let of = |j: usize| (run.joints[j].position.clone(), run.joints[j].effort.clone());
    assert_eq!([of(0), of(1)], [(q1, tau1), (q2, tau2)]);
}

#[test]
fn a_file_a_signal_is_one_run() {
    let folder = folder();
    let joined = folder.path().join("q.csv+tau.csv+t.csv");
    let run = read(&joined).unwrap();
    assert_is_whole(&run);
    assert_eq!((run.name.as_str(), &run.source), ("q+tau+t", &joined));
    // Any order, and paths of their own; the run knows the files beside the first by name.
    let long: Vec<PathBuf> = ["t.csv", "tau.csv", "q.csv"].map(|f| folder.path().join(f)).into();
    let long = long.iter().map(|f| f.to_str().unwrap()).collect::<Vec<_>>().join("+");
    let other = read(Path::new(&long)).unwrap();
    assert_is_whole(&other);
    assert_eq!(other.source, folder.path().join("t.csv+tau.csv+q.csv"));
    assert_ne!((other.sha256.len(), &other.sha256), (0, &run.sha256));
}

#[test]
fn a_file_a_signal_without_time_has_the_rate_of_the_map() {
    let folder = folder();
    let map = map("rate_hz = 100.0\nposition = 'q[{i}]'\neffort = 'tau[{i}]'");
    let options = ReadOptions { map: Some(&map), ..ReadOptions::default() };
    let run = read_run(&folder.path().join("q.csv+tau.csv"), &two_joints(), &options).unwrap();
    assert_eq!(run.joints[1].effort, signals(300)[4]);
    assert!((run.time[299] - 2.99).abs() < 1e-12);
}

#[test]
fn kinds_of_files_may_differ_and_a_column_that_several_have_must_be_the_same() {
    let folder = folder();
    let [t, q1, q2, ..] = signals(300);
    let columns = [("t", &t), ("q1", &q1), ("q2", &q2)];
    let names: Vec<(&str, &[f64])> = columns.iter().map(|(n, x)| (*n, x.as_slice())).collect();
    write_npz(&folder.path().join("q.npz"), &names).unwrap();
    let map = map("time = 't'\nposition = 'q{n}'\neffort = 'e{n}'");
    let options = ReadOptions { map: Some(&map), ..ReadOptions::default() };
    let path = folder.path().join("q.npz+named.csv");
    assert_is_whole(&read_run(&path, &two_joints(), &options).unwrap());

    let later: Vec<f64> = t.iter().map(|t| t + 1.0).collect();
    let [.., tau1, tau2] = &signals(300);
    write(folder.path(), "later.csv", &format!("t,e1,e2\n{}", text(&[&later, tau1, tau2])));
    let path = folder.path().join("q.npz+later.csv");
    let error = read_run(&path, &two_joints(), &options).unwrap_err().to_string();
    assert!(
        error.contains("later.csv: column t has other values than in the files before"),
        "{error}"
    );
}

#[test]
fn what_does_not_belong_together_is_refused_with_the_file() {
    let folder = folder();
    let [.., tau1, tau2] = &signals(200);
    write(folder.path(), "short.csv", &text(&[tau1, tau2]));
    write(folder.path(), "tau.csv", &text(&[tau1, tau2]));
    let error = read(&folder.path().join("q.csv+tau.csv+t.csv")).unwrap_err();
    assert!(error.contains("tau.csv: column tau[0] has 200 values, 300 were expected"), "{error}");
    let error = read(&folder.path().join("q.csv+gone.csv+t.csv")).unwrap_err();
    assert!(error.contains("gone.csv: there is no such file"), "{error}");
    // A file of that name, and no file at all.
    write(folder.path(), "a+b.csv", "time,one.position\n0,0\n");
    let error = read(&folder.path().join("a+b.csv")).unwrap_err();
    assert!(error.contains("a+b.csv: there is no column"), "{error}");
    let error = read(&folder.path().join("x+y.csv")).unwrap_err();
    assert!(error.contains("x+y.csv: there is no such file"), "{error}");
}
