//! Recorded logs of real arms, where they are at hand.

use std::path::PathBuf;

use logs::{LogWarning, PrepareSettings, Prepared, ReadOptions, Run, log_info, prepare, read_run};
use robot::{JointKind, Robot};

use crate::support::{robot, root};

/// The folder of recorded logs: `PLUMBLINE_DATA`, or `shared/data` beside the workspace.
fn data() -> Option<PathBuf> {
    let folder = std::env::var_os("PLUMBLINE_DATA")
        .map_or_else(|| root().join("../shared/data"), PathBuf::from);
    if folder.is_dir() {
        return Some(folder);
    }
    eprintln!("skipped: no recorded logs in {}", folder.display());
    None
}

/// A robot with these joints; their limits are wide, so that only names matter.
fn arm(prefix: &str, suffix: &str, numbers: std::ops::Range<usize>) -> Robot {
    let names: Vec<String> = numbers.map(|k| format!("{prefix}{k}{suffix}")).collect();
    let joints: Vec<_> = names.iter().map(|n| (n.as_str(), JointKind::Continuous)).collect();
    robot(&joints)
}

fn read(robot: &Robot, files: &[&str], effort: &str) -> Option<(Vec<Run>, Prepared)> {
    let folder = data()?;
    let options = ReadOptions { effort, ..ReadOptions::default() };
    let runs: Vec<Run> =
        files.iter().map(|f| read_run(&folder.join(f), robot, &options).unwrap()).collect();
    let prepared = prepare(&runs, &PrepareSettings::default()).unwrap();
    println!("{}: {}", files[0], prepared.cutoff_reason);
    for warning in &prepared.warnings {
        println!("  {warning}");
    }
    Some((runs, prepared))
}

#[test]
fn recorded_kuka_lwr4_has_a_clock_with_jitter_at_200_hz() {
    let arm = arm("lwr_", "_joint", 0..7);
    let files = ["kuka_lwr4/measurements_1.parquet", "kuka_lwr4/measurements_2.parquet"];
    let Some((runs, prepared)) = read(&arm, &files, "effort") else { return };
    let info = log_info(&runs[0], &arm);
    assert!((info.rate_hz - 200.0).abs() < 0.1 && info.gaps.is_empty());
    assert!(info.joints.iter().all(|j| j.moves && j.quantisation_step.is_none()));
    assert!(prepared.runs.iter().all(|r| (r.rate_hz - 200.0).abs() < 1e-9));
    assert!((2.0..3.0).contains(&prepared.cutoff_hz), "{}", prepared.cutoff_reason);
}

#[test]
fn recorded_kinova_gen3_is_quantised_and_has_two_efforts() {
    let arm = arm("joint_", "", 1..8);
    let files = [
        "kinova_gen3/RecordTrajectory_quadratic.parquet",
        "kinova_gen3/RunTrajectory1.parquet",
        "kinova_gen3/Trajectory1.parquet",
        "kinova_gen3/opti_traj_testing1.parquet",
        "kinova_gen3/opti_traj_testing2.parquet",
    ];
    let Some((runs, prepared)) = read(&arm, &files, "effort") else { return };
    let info = log_info(&runs[0], &arm);
    assert!((info.rate_hz - 1000.0).abs() < 1e-6);
    assert!(info.joints.iter().any(|j| j.quantisation_step.is_some()));
    assert!((3.0..30.0).contains(&prepared.cutoff_hz), "{}", prepared.cutoff_reason);
    // The command was run twice; the recordings differ.
    assert!(!prepared.warnings.iter().any(|w| matches!(w, LogWarning::Duplicate { .. })));
    let Some((sensor, _)) = read(&arm, &files[1..2], "effort_sensor") else { return };
    assert_ne!(sensor[0].joints[0].effort, runs[1].joints[0].effort);
    assert_eq!(sensor[0].extra["joint_1.effort"], runs[1].joints[0].effort);
}

#[test]
fn recorded_staubli_tx40_has_no_velocity_at_5_khz() {
    let arm = arm("joint_", "", 1..7);
    let Some((runs, prepared)) = read(&arm, &["staubli_tx40/excitation.parquet"], "effort") else {
        return;
    };
    let info = log_info(&runs[0], &arm);
    assert!((info.rate_hz - 5000.0).abs() < 1e-3);
    assert!(info.joints.iter().all(|j| j.velocity_agreement.is_none() && j.moves));
    assert!((10.0..25.0).contains(&prepared.cutoff_hz), "{}", prepared.cutoff_reason);
}

#[test]
fn recorded_barrett_wam_moves_joints_2_and_4() {
    let names = [
        "j1_base_yaw",
        "j2_shoulder_pitch",
        "j3_shoulder_yaw",
        "j4_elbow_pitch",
        "j5_wrist_yaw",
        "j6_wrist_pitch",
        "j7_palm_yaw",
    ];
    let arm = robot(&names.map(|n| (n, JointKind::Continuous)));
    let file = "barrett_wam/shoulder_elbow_sweep.parquet";
    let Some((runs, prepared)) = read(&arm, &[file], "effort") else { return };
    let moves: Vec<bool> = log_info(&runs[0], &arm).joints.iter().map(|j| j.moves).collect();
    assert_eq!(moves, [false, true, false, true, false, false, false]);
    let motion = |j: usize| log_info(&runs[0], &arm).joints[j].velocity_agreement.unwrap();
    println!("wam velocity: {:?} {:?}", motion(1), motion(3));
    assert!((2.0..6.0).contains(&prepared.cutoff_hz), "{}", prepared.cutoff_reason);
}

#[test]
fn recorded_logs_in_degrees_would_be_refused() {
    let arm = arm("lwr_", "_joint", 0..7);
    let Some((mut runs, _)) = read(&arm, &["kuka_lwr4/measurements_1.parquet"], "effort") else {
        return;
    };
    for joint in &mut runs[0].joints {
        joint.position.iter_mut().for_each(|q| *q = q.to_degrees());
    }
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("degrees.parquet");
    logs::write_parquet(&path, &runs[0]).unwrap();
    let error = read_run(&path, &arm, &ReadOptions::default()).unwrap_err();
    assert!(error.to_string().contains("looks like degrees"), "{error}");
}
