use std::fs;
use std::path::Path;

use serde_json::Value;

use crate::arm::{self, Gap};
use crate::program::{Answer, run};

/// A folder with the arm, three runs with friction of 1.5 N m and three others with `friction`.
fn folder(friction: f64) -> tempfile::TempDir {
    let folder = arm::folder(Gap::Friction(1.5));
    for k in 3..6 {
        arm::write(folder.path(), &format!("run_{k}.csv"), &arm::log(k, Gap::Friction(friction)));
    }
    folder
}

fn compare(folder: &Path, after: &[&str]) -> Answer {
    let before =
        ["compare", "--robot", "arm.urdf", "--before", "run_0.csv", "run_1.csv", "run_2.csv"];
    run(folder, &[&before[..], &["--out", "out", "--after"], after].concat())
}

const AFTER: [&str; 3] = ["run_3.csv", "run_4.csv", "run_5.csv"];

#[test]
fn friction_that_grew_is_what_changed() {
    let folder = folder(2.0);
    let answer = compare(folder.path(), &AFTER);
    assert_eq!(answer.code, 1, "{}{}", answer.out, answer.err);
    let expected = "Changed: 1 named effect of arm.\n  FR02 Coulomb friction at elbow\n    2.0";
    assert!(answer.out.starts_with(expected), "{}", answer.out);
    assert!(answer.out.contains(", was 1.5") && answer.out.contains("    in the first logs 1.5"));
    assert_eq!(answer.out.matches(", was").count(), 1, "{}", answer.out);
    assert!(answer.out.lines().all(|line| line.chars().count() <= 100), "{}", answer.out);
    for (side, level, nominal) in [("before", 1.5, 0.0), ("after", 2.0, 1.5)] {
        let out = folder.path().join("out").join(side);
        let text = fs::read_to_string(out.join("diagnosis.json")).unwrap();
        let value: Value = serde_json::from_str(&text).unwrap();
        let said = &value["findings"][0]["parameters"]["level"];
        for (name, expected) in [("value", level), ("nominal", nominal)] {
            let number = said[name].as_f64().unwrap();
            assert!((number - expected).abs() < 0.02, "{side} {name} {number}");
        }
        assert!(out.join("report.html").is_file() && out.join("extended.toml").is_file());
    }
}

#[test]
fn what_changed_is_told_for_programs_with_the_logs_of_both_sides() {
    let folder = folder(2.0);
    let answer = compare(folder.path(), &[&AFTER[..], &["--json", "--quiet"]].concat());
    assert_eq!((answer.code, answer.err.as_str()), (1, ""));
    let told: Value = serde_json::from_str(&answer.out).unwrap();
    assert_eq!(told["schema"], "plumbline.comparison/1");
    let [change] = told["changes"].as_array().unwrap().as_slice() else { panic!("{told}") };
    assert_eq!((&change["code"], &change["joint"]), (&"FR02".into(), &"elbow".into()));
    let number = |value: &Value| value.as_f64().unwrap();
    let level = &change["parameters"]["level"];
    assert!((number(&level["value"]) - 2.0).abs() < 0.02, "{level}");
    assert!((number(&level["nominal"]) - 1.5).abs() < 0.02, "{level}");
    let first = &told["in_first_logs"][0]["parameters"]["level"]["value"];
    assert!((number(first) - 1.5).abs() < 0.02, "{told}");
    for (side, logs) in
        [("before", ["run_0", "run_1", "run_2"]), ("after", ["run_3", "run_4", "run_5"])]
    {
        let files = told["provenance"][side]["files"].as_array().unwrap().iter();
        let paths: Vec<&str> = files.map(|file| file["path"].as_str().unwrap()).collect();
        let expected = logs.map(|log| format!("../{log}.csv"));
        assert_eq!(paths[0], "../arm.urdf");
        assert_eq!(paths[1..], expected, "{side}");
    }
    let written = fs::read_to_string(folder.path().join("out/comparison.json")).unwrap();
    assert_eq!(written, answer.out);
}

#[test]
fn where_nothing_changed_it_says_so() {
    let folder = folder(1.5);
    let answer = compare(folder.path(), &AFTER);
    assert_eq!(answer.code, 0, "{}{}", answer.out, answer.err);
    let expected = "Nothing that these logs could show has changed in arm.\n";
    assert!(answer.out.starts_with(expected), "{}", answer.out);
    assert!(answer.out.contains("Found before, and held"), "{}", answer.out);
}

#[test]
fn a_log_on_both_sides_is_refused_before_anything_is_written() {
    let folder = folder(1.5);
    let answer = compare(folder.path(), &["run_3.csv", "run_1.csv"]);
    assert_eq!(answer.code, 3, "{}{}", answer.out, answer.err);
    assert!(answer.err.contains("run_1: it is among the logs before and after"), "{}", answer.err);
    assert!(!folder.path().join("out").exists());
}
