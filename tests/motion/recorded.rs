//! A recorded log as reference.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use logs::{Channels, Run, write_parquet};
use motion::{MotionError, MotionSpec};
use robot::Robot;

use crate::support::{build, gantry};

/// 20 s at 250 Hz of slow sines; the elbow does not move.
fn sine(joint: usize, t: f64) -> [f64; 2] {
    let (amplitude, w) = [(0.4, 1.3), (1.0, 0.9), (0.0, 0.0)][joint];
    [0.5 + amplitude * (w * t).sin(), amplitude * w * (w * t).cos()]
}

fn log(robot: &Robot, path: &Path, keep: impl Fn(f64) -> bool) {
    let time: Vec<f64> = (0..5000).map(|k| 100.0 + 0.004 * f64::from(k)).collect();
    let time: Vec<f64> = time.into_iter().filter(|t| keep(t - 100.0)).collect();
    let channels = |(j, name): (usize, &str)| Channels {
        name: name.to_owned(),
        position: time.iter().map(|t| sine(j, t - 100.0)[0]).collect(),
        effort: vec![0.0; time.len()],
        ..Channels::default()
    };
    let joints = robot.joint_names().enumerate().map(channels).collect();
    let (source, sha256, extra) = (PathBuf::new(), String::new(), BTreeMap::new());
    let name = "run".to_owned();
    let run = Run {
        name,
        source,
        sha256,
        is_torn: false,
        mended: Vec::new(),
        time: time.clone(),
        joints,
        extra,
    };
    write_parquet(path, &run).unwrap();
}

#[test]
fn a_recorded_log_is_followed_in_position_and_velocity() {
    let folder = tempfile::tempdir().unwrap();
    let robot = gantry();
    log(&robot, &folder.path().join("run.parquet"), |_| true);
    let toml = "[recorded]\nfile = \"run.parquet\"\ncutoff_hz = 5.0";
    let spec: MotionSpec = toml::from_str(toml).unwrap();
    let motion = spec.build(&robot, folder.path()).unwrap();
    // 1.5 periods of the cut-off are left out at each end; the fades add 2 s.
    assert!((motion.duration_s() - (20.0 - 0.004 - 0.6 + 2.0)).abs() < 0.01);
    for k in 0..1000 {
        let t = 2.0 + (motion.duration_s() - 4.0) * f64::from(k) / 1000.0;
        let state = motion.at(t);
        // One second of the log is passed in the fade.
        for j in 0..3 {
            let [q, qd] = sine(j, t - 1.0 + 0.3);
            assert!((state.q[j] - q).abs() < 1e-5, "{} {q} at {t}", state.q[j]);
            assert!((state.qd[j] - qd).abs() < 1e-4, "{} {qd} at {t}", state.qd[j]);
        }
    }
}

#[test]
fn a_log_with_a_gap_and_a_log_that_is_not_there_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let robot = gantry();
    log(&robot, &folder.path().join("run.parquet"), |t| !(8.0..9.0).contains(&t));
    let spec: MotionSpec = toml::from_str("[recorded]\nfile = \"run.parquet\"").unwrap();
    let error = spec.build(&robot, folder.path()).unwrap_err();
    assert_eq!(error, MotionError::Split { key: "recorded.file".to_owned(), found: 2 });
    let error = build(&robot, "[recorded]\nfile = \"nowhere.csv\"").unwrap_err();
    assert_eq!(error.key(), "recorded.file");
}

#[test]
fn the_log_of_a_real_wam_becomes_a_motion() {
    let Some(folder) = checks::recorded::folder() else { return };
    let toml = "[recorded]\nfile = \"barrett_wam/shoulder_elbow_sweep.parquet\"";
    let spec: MotionSpec = toml::from_str(toml).unwrap();
    let motion = spec.build(&checks::synthetic::wam(), &folder).unwrap();
    let fastest = |j: usize| {
        let times = (0..2000).map(|k| motion.duration_s() * f64::from(k) / 2000.0);
        times.map(|t| motion.at(t).qd[j].abs()).fold(0.0, f64::max)
    };
    assert!(fastest(1) > 0.3 && fastest(3) > 0.3, "joints 2 and 4 move in this log");
    assert!(fastest(0) < 0.1, "joint 1 does not");
}
