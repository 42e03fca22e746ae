use std::fs;
use std::path::Path;

use serde_json::Value;

use crate::arm;
use crate::files::{json, names};
use crate::program::{Answer, plumbline, run};

const SCENARIOS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenarios");

/// A folder with the scenario of a WAM with friction that its description lacks.
fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let motion = |name: &str, seed: u64, duration_s: f64| {
        format!(
            "[[run]]\nname = \"{name}\"\nmotion.sinusoids = {{ seed = {seed}, terms = 3, \
             lowest_hz = 0.3, highest_hz = 1.0, duration_s = {duration_s:?}, fade_s = 0.5 }}\n"
        )
    };
    let arm = format!(
        "extends = {:?}\nseed = 3\neffect = [{{ viscous_friction = {{ joint = \
         \"j2_shoulder_pitch\", viscous_nm_s_per_rad = 5.0 }} }}]\n{}{}{}",
        format!("{SCENARIOS}/arms/wam.toml"),
        motion("first", 21, 6.0),
        motion("second", 22, 6.0),
        motion("last", 23, 4.0),
    );
    arm::write(folder.path(), "arm.toml", &arm);
    folder
}

fn made(folder: &Path, arguments: &[&str]) -> Answer {
    let answer = run(folder, &[&["run"], arguments].concat());
    assert_eq!(answer.code, 0, "{}{}", answer.out, answer.err);
    answer
}

fn metrics(out: &Path) -> Value {
    json(&out.join("metrics.json"))
}

/// The stages that were made, those that were there before left out.
fn stages(answer: &Answer) -> Vec<&str> {
    let lines = answer.err.lines().filter(|line| !line.ends_with("made before"));
    lines.filter_map(|line| line.split_whitespace().next()).collect()
}

const ALL: [&str; 5] = ["simulation", "diagnosis", "models", "replay", "tracking"];

#[test]
fn what_was_put_in_is_found_and_finding_it_pays_three_times_over() {
    let folder = folder();
    let answer = made(folder.path(), &["arm.toml"]);
    assert_eq!(stages(&answer), ALL);
    assert!(answer.out.contains("The effect that was put in was found."), "{}", answer.out);
    assert!(answer.out.contains("your own log   plumbline diagnose"), "{}", answer.out);
    let out = folder.path().join("out/arm");
    let value = metrics(&out);
    assert_eq!(value["schema"], "plumbline.run/1");
    assert_eq!((&value["test"][0], &value["learned"][1]), (&"last".into(), &"second".into()));
    assert_eq!(value["score"]["exactly"], true, "{}", value["score"]);
    let estimate = value["score"]["put_in"][0]["sizes"][0]["estimate"]["value"].as_f64().unwrap();
    assert!((estimate - 5.0).abs() < 0.25, "{estimate}");

    let shoulder = |model: &Value, key: &str| model[key][1].as_f64().unwrap();
    let [cad, named] = [&value["torque"][0], &value["torque"][1]];
    assert_eq!((&cad["model"], &named["model"]), (&"cad".into(), &"named".into()));
    assert!(shoulder(named, "nmse") < 0.1 * shoulder(cad, "nmse"), "{cad} {named}");
    for (window, window_s) in [0.05, 0.2, 1.0].into_iter().enumerate() {
        let window = &value["forward"]["windows"][window];
        assert_eq!(window["window_s"], window_s);
        let [before, after] =
            ["nominal", "extended"].map(|model| window[model]["tip_rms_m"].as_f64().unwrap());
        assert!(after < 0.5 * before, "{window}");
    }
    let [cad, named] = [0, 1].map(|run| value["tracking"][run]["tip_rms_m"].as_f64().unwrap());
    assert!(named < 0.5 * cad, "{named} {cad}");

    let page = fs::read_to_string(out.join("report.html")).unwrap();
    for expected in ["FR01 viscous friction at j2_shoulder_pitch", "What was ruled out", "<svg"] {
        assert!(page.contains(expected), "{expected} is missing");
    }
    for file in ["recording.rrd", "diagnosis/extended.toml", "logs/last.parquet", "scenario.toml"] {
        assert!(out.join(file).is_file(), "{file} is missing");
    }
}

#[test]
fn the_same_seed_gives_the_same_numbers_from_the_scenario_that_a_run_leaves_too() {
    let folder = folder();
    let quiet = |arguments: &[&str]| made(folder.path(), &[arguments, &["--quiet"]].concat());
    assert_eq!(quiet(&["arm.toml", "--out", "a"]).out, "");
    quiet(&["a/scenario.toml", "--out", "b"]);
    let json = made(folder.path(), &["arm.toml", "--seed", "3", "--out", "c", "--json"]).out;
    let read =
        |out: &str| fs::read_to_string(folder.path().join(out).join("metrics.json")).unwrap();
    assert_eq!(read("a"), read("b"));
    assert_eq!(read("a"), json);
    quiet(&["arm.toml", "--seed", "4", "--out", "c"]);
    assert_ne!(read("a"), read("c"));
}

#[test]
fn a_finished_stage_is_kept_and_what_was_changed_or_damaged_is_made_again() {
    let folder = folder();
    let again = |scenario: &str| made(folder.path(), &[scenario, "--out", "out"]);
    assert_eq!(stages(&again("arm.toml")), ALL);
    let first = metrics(&folder.path().join("out"));
    assert!(stages(&again("arm.toml")).is_empty());

    // What is made again comes out the same, so that what follows from it is kept.
    let out = folder.path().join("out");
    fs::write(out.join("logs/first.parquet"), "damaged").unwrap();
    assert_eq!(stages(&again("arm.toml")), ["simulation"]);
    fs::remove_file(out.join("diagnosis/extended.toml")).unwrap();
    fs::write(out.join("stages/replay.json"), "{\"inputs\"").unwrap();
    assert_eq!(stages(&again("arm.toml")), ["diagnosis", "replay"]);
    assert_eq!(metrics(&out), first);

    // Other gains change nothing but the tracking.
    fs::copy(out.join("scenario.toml"), out.join("other.toml")).unwrap();
    let other = made(
        folder.path(),
        &["out/other.toml", "--set", "control.gains=compliant", "--out", "out"],
    );
    assert_eq!(stages(&other), ["tracking"]);
    assert_eq!(metrics(&out)["gains"], "compliant");
    assert_eq!(metrics(&out)["forward"], first["forward"]);
}

#[test]
fn a_scenario_that_leaves_nothing_to_test_on_is_shown_where_it_does() {
    let folder = folder();
    let text = fs::read_to_string(folder.path().join("arm.toml")).unwrap();
    let one = text.split("[[run]]").take(2).collect::<Vec<_>>().join("[[run]]");
    arm::write(folder.path(), "one.toml", &one);
    let tracked = "plant = \"arm.toml\"\nmotion.sinusoids = { seed = 1, terms = 2, lowest_hz = 0.3, \
                   highest_hz = 1.0, duration_s = 2.0, fade_s = 0.5 }\nfeedforward = [\"none\"]\n[control]\n\
                   gains = \"compliant\"\n[learn]\ntrain = [\"first\", \"second\", \"last\"]\n";
    arm::write(folder.path(), "tracked.toml", tracked);
    for (arguments, expected) in [
        (&["one.toml"][..], "one run, two or more were expected"),
        (&["tracked.toml"], "every run of the plant is learned from"),
        (&["arm.toml", "--set", "efect=1"], "unknown key `efect`, did you mean `effect`?"),
        (&["nowhere.toml"], "nowhere.toml"),
    ] {
        let answer = run(folder.path(), &[&["run"], arguments].concat());
        assert_eq!(answer.code, 3, "{arguments:?}: {}", answer.err);
        assert!(answer.err.contains(expected), "{arguments:?}: {}", answer.err);
        assert!(!folder.path().join("out").exists(), "{arguments:?} left something");
    }
}

#[test]
fn a_demo_needs_nothing_and_finds_both_effects_that_it_hides() {
    let folder = tempfile::tempdir().unwrap();
    let answer = run(folder.path(), &["demo"]);
    assert_eq!(answer.code, 0, "{}{}", answer.out, answer.err);
    assert!(answer.out.contains("Both effects that were put in were found."), "{}", answer.out);
    assert!(answer.out.lines().count() < 40, "no screenful: {}", answer.out);
    let value = metrics(&folder.path().join("out/demo"));
    assert_eq!(value["score"]["exactly"], true);
    assert_eq!(value["score"]["stray"].as_array().unwrap().len(), 0);
    let report = fs::metadata(folder.path().join("out/demo/report.html")).unwrap();
    assert!(report.len() < 2_000_000, "{} bytes", report.len());
}

/// The demo is ended as soon as its first files are there.
#[test]
fn the_demo_of_another_arm_has_a_folder_of_its_own() {
    let folder = tempfile::tempdir().unwrap();
    for (robot, out) in [("panda", "demo_panda"), ("so101", "demo_so101"), ("wam7", "demo")] {
        let mut command = plumbline();
        command.current_dir(folder.path()).args(["demo", "--robot", robot, "--quiet"]);
        let mut demo = command.spawn().unwrap();
        let source = folder.path().join("out").join(out).join("source/robots").join(robot);
        let begin = std::time::Instant::now();
        while !source.is_dir() && begin.elapsed().as_secs() < 60 {
            std::thread::sleep(std::time::Duration::from_millis(20));
        }
        demo.kill().unwrap();
        demo.wait().unwrap();
        assert!(source.is_dir(), "{}", source.display());
    }
    assert_eq!(names(&folder.path().join("out")), ["demo", "demo_panda", "demo_so101"]);
}

#[test]
fn a_figure_is_left_to_the_program_that_draws_it() {
    let folder = tempfile::tempdir().unwrap();
    let figure = concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenarios/paper/fig2_learning.toml");
    let answer = run(folder.path(), &["run", figure, "--out", "out"]);
    assert_eq!((answer.code, answer.out.as_str()), (3, ""));
    assert!(answer.err.contains("it is a figure of a paper"), "{}", answer.err);
    assert!(answer.err.contains("help: plumbline-bench figure draws it"), "{}", answer.err);
    assert!(!folder.path().join("out").exists());
}
