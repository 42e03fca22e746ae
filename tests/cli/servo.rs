//! Servos that follow a goal and tell no torque.

use std::fs;
use std::path::Path;

use checks::arms::workspace_root;
use checks::lerobot::{Layout, write};
use logs::{Channel, ReadOptions, Run, read_run};
use robot::{Loaded, Robot};
use serde_json::Value;

use crate::arm;
use crate::program::{Answer, run};

/// Gains of robots/so101/robot.toml, with which the arm is simulated.
const KP: [f64; 6] = [20.0, 43.0, 22.0, 10.0, 10.0, 10.0];
const KD: [f64; 6] = [1.7, 2.4, 1.4, 0.88, 0.85, 0.85];

/// Three runs of the simulated arm, as the demo moves it, with this friction at the elbow (N m).
fn simulated(folder: &Path, level_nm: f64) -> Vec<Run> {
    let root = workspace_root();
    let motion = |k: u32| {
        format!(
            "[[run]]\nname = \"run_{k}\"\nmotion.sinusoids = {{ seed = 1{k}, terms = 4, lowest_hz = 0.1, \
             highest_hz = 0.6, duration_s = 15.0 }}\n"
        )
    };
    let effect = format!(
        "[[effect]]\ncoulomb_friction = {{ joint = \"elbow_flex\", level_nm = {level_nm} }}\n"
    );
    let scenario = format!(
        "extends = \"{}\"\nseed = 1\n{}{}",
        root.join("scenarios/arms/so101.toml").display(),
        if level_nm > 0.0 { effect } else { String::new() },
        (1..4).map(motion).collect::<String>()
    );
    arm::write(folder, "scenario.toml", &scenario);
    let answer = run(folder, &["simulate", "scenario.toml", "--out", "simulated"]);
    assert_eq!(answer.code, 0, "{}", answer.err);
    let Loaded { robot, .. } = Robot::load(&root.join("robots/so101/robot.toml")).unwrap();
    let read = |k: u32| {
        let path = folder.join(format!("simulated/run_{k}.parquet"));
        read_run(&path, &robot, &ReadOptions::default()).unwrap()
    };
    (1..4).map(read).map(as_goals).collect()
}

/// The goals under which a loop `kp (goal - q) - kd qd` moves the arm as the simulated one does, whose damping
/// is of the error: `goal = q_ref + kd / kp qd_ref`.
pub fn as_goals(mut run: Run) -> Run {
    for ((joint, kp), kd) in run.joints.iter_mut().zip(KP).zip(KD) {
        let (q, qd) =
            (joint.desired_position.take().unwrap(), joint.desired_velocity.take().unwrap());
        joint.desired_position = Some(q.iter().zip(&qd).map(|(q, qd)| q + kd / kp * qd).collect());
    }
    run
}

fn diagnosed(folder: &Path) -> (Answer, Value) {
    let answer =
        run(folder, &["diagnose", "--robot", "servo.toml", "--log", "set", "--out", "out"]);
    assert!(answer.code <= 1, "{}", answer.err);
    let text = fs::read_to_string(folder.join("out/diagnosis.json")).unwrap();
    (answer, serde_json::from_str(&text).unwrap())
}

/// A folder with a dataset of goals and positions alone, and the arm with its position loop.
fn folder(level_nm: f64) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let runs = simulated(folder.path(), level_nm);
    write(
        &folder.path().join("set"),
        &runs,
        Layout::OneFile,
        &[Channel::Effort, Channel::Velocity],
    );
    let robots = workspace_root().join("robots/so101");
    fs::copy(robots.join("robot.urdf"), folder.path().join("robot.urdf")).unwrap();
    let toml = fs::read_to_string(robots.join("robot.toml")).unwrap();
    let source = format!(
        "effort_source = {{ position_loop = {{ kp_nm_per_rad = {KP:?}, kd_nm_s_per_rad = {KD:?} }} }}\n"
    );
    arm::write(folder.path(), "servo.toml", &(source + &toml));
    arm::write(folder.path(), "plain.toml", &toml);
    folder
}

fn kinds(diagnosis: &Value) -> Vec<(String, String)> {
    let of = |finding: &Value| {
        let text = |key: &str| finding[key].as_str().unwrap_or_default().to_owned();
        (text("effect"), text("joint"))
    };
    diagnosis["findings"].as_array().unwrap().iter().map(of).collect()
}

#[test]
fn a_friction_is_named_from_goals_and_positions_alone() {
    let folder = folder(0.3);
    let (answer, diagnosis) = diagnosed(folder.path());
    let found = kinds(&diagnosis);
    assert!(
        found.contains(&("coulomb_friction".to_owned(), "elbow_flex".to_owned())),
        "{found:?}\n{}",
        answer.out
    );
    let said = diagnosis.to_string();
    assert!(said.contains("the scale of all efforts cannot be known"), "{said}");
    let extended = fs::read_to_string(folder.path().join("out/extended.toml")).unwrap();
    assert!(extended.contains("position_loop"), "{extended}");
}

#[test]
fn without_the_friction_none_is_named_and_without_the_loop_the_effort_is_missing() {
    let folder = folder(0.0);
    let (answer, diagnosis) = diagnosed(folder.path());
    let found = kinds(&diagnosis);
    assert!(
        !found.iter().any(|(effect, _)| effect.contains("friction")),
        "{found:?}\n{}",
        answer.out
    );
    let plain = ["diagnose", "--robot", "plain.toml", "--log", "set", "--out", "no"];
    let answer = run(folder.path(), &plain);
    assert_eq!(answer.code, 3);
    assert!(answer.err.contains("observation.effort[shoulder_pan]"), "{}", answer.err);
    assert!(answer.err.contains("effort_source in robot.toml"), "{}", answer.err);
}
