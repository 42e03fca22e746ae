//! Models that entrants of CauseBench hand in, replayed in MuJoCo.

use std::fs;
use std::path::Path;

use checks::arms::workspace_root;
use checks::book::can;
use checks::program::run;
use serde_json::{Value, json};

/// Inertia of the arm (kg m^2) and the effort on it (N m).
const INERTIA: f64 = 0.5;
const EFFORT: f64 = 0.25;

/// Rows a second of the held-out log, which lasts 4 s.
const RATE_HZ: usize = 1000;
const ROWS: usize = 4 * RATE_HZ + 1;

/// Times of the drifts (s).
const TIMES_S: [f64; 3] = [0.05, 0.2, 1.0];

/// Length of a step of the replay (s).
const STEP_S: f64 = 1e-3;

/// An MJCF of one hinge, with this inertia about it.
fn model(inertia: f64) -> String {
    format!(
        r#"<mujoco><option gravity="0 0 0"/><worldbody><body name="link"><joint name="hinge" axis="0 0 1"/>
        <inertial pos="0 0 0" mass="1" diaginertia="{inertia} {inertia} {inertia}"/></body></worldbody></mujoco>"#
    )
}

/// A set of as many trials as there are models: an arm at rest under one effort, `q = EFFORT / INERTIA t^2 / 2`.
fn make_set(folder: &Path, models: &[String]) {
    let time: Vec<f64> = (0..ROWS).map(|k| k as f64 / RATE_HZ as f64).collect();
    let position = time.iter().map(|t| 0.5 * EFFORT / INERTIA * t * t).collect();
    let columns = vec![("time".to_owned(), time), ("hinge.position".to_owned(), position)];
    logs::write_npz(&folder.join("held_out.npz"), &columns).unwrap();
    fs::create_dir(folder.join("me")).unwrap();
    let (mut trials, mut truths) = (Vec::new(), serde_json::Map::new());
    for (k, text) in models.iter().enumerate() {
        let name = format!("trial_{k}");
        trials
            .push(json!({"name": name, "joints": ["hinge"], "held_out": {"npz": "held_out.npz"}}));
        let answer = json!({"model": format!("{name}.xml")});
        fs::write(folder.join(format!("me/{name}.json")), answer.to_string()).unwrap();
        fs::write(folder.join(format!("me/{name}.xml")), text).unwrap();
        truths.insert(name, json!({"held_out_effort": {"hinge": vec![EFFORT; ROWS]}}));
    }
    fs::write(folder.join("manifest.json"), json!({"trials": trials}).to_string()).unwrap();
    fs::write(folder.join("truth.json"), json!({"trials": truths}).to_string()).unwrap();
}

#[test]
fn a_model_of_twice_the_inertia_drifts_by_half_the_way_and_hostile_ones_have_no_drift() {
    if !can("python3", &["-c", "import mujoco, numpy"]) {
        println!("no mujoco for python3 here: models are not replayed");
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    let include = r#"<mujoco><include file="/etc/passwd"/></mujoco>"#.to_owned();
    let other = model(INERTIA).replace("hinge", "elbow");
    make_set(path, &[model(INERTIA), model(2.0 * INERTIA), include, other]);
    let script = workspace_root().join("tests/benches/replay_answers.py");
    let script = script.to_str().unwrap();
    let answer = run("python3", path, &[script, ".", "me", "truth.json", "drifts.json"]);
    assert_eq!((answer.code, answer.err.as_str()), (0, ""), "{}", answer.out);
    let drifts: Value =
        serde_json::from_slice(&fs::read(path.join("drifts.json")).unwrap()).unwrap();
    let of = |trial: &str, k: usize| drifts["trials"][trial][k].as_f64().unwrap();
    let acceleration = EFFORT / INERTIA;
    for (k, time) in TIMES_S.iter().enumerate() {
        // A step changes the velocity first: the position is ahead by half a step of it.
        let step = acceleration * time * STEP_S;
        assert!(of("trial_0", k) < step, "{drifts}");
        let expected = 0.25 * acceleration * time * time;
        assert!((of("trial_1", k) - expected).abs() < step, "{drifts}");
    }
    assert!(drifts["trials"]["trial_2"].is_null() && drifts["trials"]["trial_3"].is_null());
    let told = |words: &str| answer.out.lines().any(|line| line.contains(words));
    assert!(told("trial_2: a model of at most 4 MiB") && told("trial_3: joints"), "{}", answer.out);
}
