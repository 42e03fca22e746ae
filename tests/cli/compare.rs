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
    let before = ["../arm.urdf", "../run_0.csv", "../run_1.csv", "../run_2.csv"];
    let found = ["before/extended.toml", "before/robot.urdf"];
    let after = ["../run_3.csv", "../run_4.csv", "../run_5.csv"];
    for (side, expected) in [("before", before.to_vec()), ("after", [&found[..], &after].concat())]
    {
        let files = told["provenance"][side]["files"].as_array().unwrap().iter();
        let paths: Vec<&str> = files.map(|file| file["path"].as_str().unwrap()).collect();
        assert_eq!(paths, expected, "{side}");
    }
    let written = fs::read_to_string(folder.path().join("out/comparison.json")).unwrap();
    assert_eq!(written, answer.out);
}

fn read_json(path: &Path) -> Value {
    serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap()
}

/// The other logs are diagnosed about the robot that the first ones extend: what is made of their diagnosis starts there.
#[test]
fn the_robot_as_the_first_logs_found_it_is_the_nominal_one_of_the_others() {
    let folder = folder(2.0);
    let path = folder.path();
    assert_eq!(compare(path, &AFTER).code, 1);
    let again = ["diagnose", "--robot", "out/before/extended.toml", "--no-recording", "--quiet"];
    let again = run(path, &[&again[..], &["--out", "out/again", "--log"], &AFTER].concat());
    assert_eq!(again.code, 0, "{}", again.err);
    let files = |name: &str| {
        let file = path.join("out").join(name).join("diagnosis.json");
        read_json(&file)["provenance"]["files"].clone()
    };
    assert_eq!(files("after"), files("again"));

    arm::write(path, "held_out.csv", &arm::log(6, Gap::Friction(2.0)));
    let nominal = |more: &[&str]| {
        let export = ["export", "out/after", "--to", "urdf", "--log", "held_out.csv", "--json"];
        let answer = run(path, &[&export[..], more].concat());
        assert_eq!((answer.code, answer.err.as_str()), (0, ""));
        let told: Value = serde_json::from_str(&answer.out).unwrap();
        let model = &told["loss"]["models"][0];
        let file = model["described_by"].as_str().unwrap().to_owned();
        (file, model["all_nm"].as_f64().unwrap())
    };
    let own = nominal(&[]);
    assert_eq!(own.0, "out/before/extended.toml");
    assert_eq!(own, nominal(&["--nominal", "out/before/extended.toml"]));
    let given = nominal(&["--nominal", "arm.urdf"]).1;
    assert!(given > 3.0 * own.1, "2.0 N m of friction against 0.5 N m: {given} and {}", own.1);

    let pair = ["--separate", "FR01@elbow", "--from", "FR02@elbow", "--duration-s", "10"];
    let design = ["design", "--diagnosis", "out/after", "--out", "next"];
    let design = run(path, &[&design[..], &pair].concat());
    assert_eq!((design.code, design.err.contains("changed since")), (0, false), "{}", design.err);
    let motion = fs::read_to_string(path.join("next/motion.toml")).unwrap();
    assert!(motion.contains("/out/before/extended.toml\"\n"), "{motion}");

    // The page of both names what both read.
    let page = fs::read_to_string(path.join("out/report.html")).unwrap();
    for file in ["arm.urdf", "run_0.csv", "run_5.csv"] {
        assert!(page.contains(file), "{file}");
    }
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
