use std::fs;
use std::path::Path;
use std::process::Stdio;
use std::time::Duration;

use learner::{Model, ModelKind, TorqueModel};
use robot::Robot;
use serde_json::Value;

use crate::arm::{self, Gap};
use crate::files::json;
use crate::program::{Answer, plumbline, run};

const LOGS: [&str; 7] =
    ["--robot", "arm.urdf", "--train", "run_0.csv", "run_1.csv", "--test", "run_2.csv"];

fn learn(folder: &Path, more: &[&str]) -> Answer {
    run(folder, &[&["learn"], &LOGS[..], more].concat())
}

fn errors<'a>(comparison: &'a Value, model: &str) -> Vec<&'a Value> {
    let models = comparison["models"].as_array().unwrap();
    let row = models.iter().find(|row| row["name"] == model).unwrap();
    row["nmse"].as_array().unwrap().iter().collect()
}

#[test]
fn models_are_compared_on_a_log_that_took_no_part_and_saved() {
    let folder = arm::folder(Gap::Friction(1.5));
    let models = ["--models", "cad,rbd,gp,gp-rbd,rbd", "--points", "200", "--out", "out"];
    let answer = learn(folder.path(), &models);
    assert_eq!(answer.code, 0, "{}{}", answer.out, answer.err);
    for expected in ["nMSE", "gp-rbd", "elbow", "training (s)", "models         out/models"] {
        assert!(answer.out.contains(expected), "{expected} is missing in {}", answer.out);
    }
    assert!(!answer.out.contains('\u{1b}') && answer.err.is_empty(), "{answer:?}");

    let comparison = json(&folder.path().join("out/learning.json"));
    assert_eq!(comparison["schema"], "plumbline.learning/1");
    let counts = ["train", "regression", "test"]
        .map(|set| comparison[set]["logs"].as_array().unwrap().len());
    assert_eq!(counts, [2, 2, 1]);
    assert_eq!(comparison["train"]["points"], 200);
    // What is named twice is learned once.
    assert_eq!(comparison["models"].as_array().unwrap().len(), 4);
    let elbow = |model| errors(&comparison, model)[1].as_f64().unwrap();
    // Friction is in no rigid body, and a process about them learns what they leave.
    assert!(elbow("rbd") > 0.01 && elbow("gp-rbd") < 0.5 * elbow("rbd"), "{comparison}");
    assert!(elbow("gp-rbd") < elbow("gp"), "{comparison}");

    let robot = Robot::load(&folder.path().join("arm.urdf")).unwrap().robot;
    let model = Model::load(&folder.path().join("out/models/gp-rbd.parquet"), &robot).unwrap();
    assert_eq!((model.kind, model.joints()), (ModelKind::GpRbd, 2));
    let svg = fs::read_to_string(folder.path().join("out/figure.svg")).unwrap();
    assert!(svg.contains("arm: error of learned models by joint"), "{svg}");
    let mut names: Vec<_> = fs::read_dir(folder.path().join("out"))
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    assert_eq!(names, ["figure.svg", "learning.json", "models", "report.html"]);
}

#[test]
fn the_same_command_learns_the_same_models() {
    let folder = arm::folder(Gap::Ripple(1.0));
    let learn = |out: &str| {
        let more =
            ["--models", "gp-rbd-prior,rbd-kernel", "--points", "120", "--json", "--out", out];
        let answer = learn(folder.path(), &more);
        assert_eq!(answer.code, 0, "{}", answer.err);
        let comparison: Value = serde_json::from_str(&answer.out).unwrap();
        let errors: Vec<String> = ["gp-rbd-prior", "rbd-kernel"]
            .iter()
            .flat_map(|model| errors(&comparison, model))
            .map(Value::to_string)
            .collect();
        (errors, fs::read(folder.path().join(out).join("models/rbd-kernel.parquet")).unwrap())
    };
    assert!(learn("a") == learn("b"));
}

#[test]
fn a_recording_cannot_be_both_learned_from_and_tested_on() {
    let folder = arm::folder(Gap::None);
    fs::copy(folder.path().join("run_1.csv"), folder.path().join("copy.csv")).unwrap();
    let arguments = ["learn", "--robot", "arm.urdf", "--train", "run_0.csv", "copy.csv"];
    let more = ["--test", "run_2.csv", "run_1.csv", "--out", "out"];
    let answer = run(folder.path(), &[&arguments[..], &more].concat());
    assert_eq!(answer.code, 2);
    assert_eq!(
        answer.err,
        "error: run_1.csv: it is the recording that copy.csv holds, a test needs a log that took \
         no part in the training\n"
    );
    assert!(!folder.path().join("out").exists());
}

#[test]
fn what_cannot_be_learned_is_said_before_anything_is_written() {
    let folder = arm::folder(Gap::None);
    let cases: [(&[&str], &str); 5] = [
        (&["--models", "rbd,gpp"], "gpp is no model, cad, rbd, rbd-consistent, gp"),
        (&["--prior", "share=-1"], "errors, evidence or share= with a positive number"),
        (&["--columns", "all"], "inertial or drives was expected"),
        (&["--points", "0"], "points: 0 was found, at least one expected"),
        (&["--cutoff-hz", "0"], "a positive number was expected"),
    ];
    for (arguments, expected) in cases {
        let answer = learn(folder.path(), &[arguments, &["--out", "out"]].concat());
        assert_eq!(answer.code, 2, "{arguments:?}");
        assert!(answer.err.contains(expected), "{expected} is missing in {}", answer.err);
        assert!(!folder.path().join("out").exists());
    }
    let answer = learn(folder.path(), &["--models", "named", "--out", "out"]);
    assert_eq!(answer.code, 2);
    assert!(answer.err.contains("give it with --named"), "{}", answer.err);
    let answer = run(folder.path(), &["learn", "--robot", "arm.urdf", "--out", "out"]);
    assert_eq!(answer.code, 2);
    assert!(answer.err.contains("--train") && answer.err.contains("--test"), "{}", answer.err);
}

#[cfg(unix)]
#[test]
fn an_interrupt_ends_the_searches_and_keeps_what_they_have_found() {
    let folder = arm::folder(Gap::Ripple(1.0));
    let more = ["--models", "gp,rbd-kernel", "--points", "1500", "--out", "out"];
    let child = plumbline()
        .current_dir(folder.path())
        .args([&["learn"], &LOGS[..], &more].concat())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    // The folder is made after the program began to listen, and before it learns.
    while !folder.path().join("out").exists() {
        std::thread::sleep(Duration::from_millis(10));
    }
    let id = child.id().to_string();
    assert!(std::process::Command::new("kill").args(["-INT", &id]).status().unwrap().success());
    let answer: Answer = child.wait_with_output().unwrap().into();
    assert_eq!(answer.code, 0, "{answer:?}");
    let remark = "gp: the search at shoulder, elbow: stopped before it converged";
    assert!(answer.out.contains(remark), "{}", answer.out);
    // Of the rigid-body kernel's searches, too.
    assert!(answer.out.contains("rbd-kernel: Ctrl-C ended searches"), "{}", answer.out);
    assert!(folder.path().join("out/models/gp.parquet").exists());
}
