use std::fs;
use std::path::{Path, PathBuf};
use std::thread::sleep;
use std::time::{Duration, Instant};

use document::Document;
use experiment::TrackingScenario;
use simulator::scenario::Scenario;

use crate::arm;
use crate::files::workspace;
use crate::program::{Answer, plumbline, run};

const ROBOT: &str = "urdf = \"arm.urdf\"\n\
    joint.shoulder = { rotor_inertia_kg_m2 = 0.1, kp_nm_per_rad = 400.0, kd_nm_s_per_rad = 20.0 }\n\
    joint.elbow = { rotor_inertia_kg_m2 = 0.1, kp_nm_per_rad = 200.0, kd_nm_s_per_rad = 10.0 }\n";

const SENSORS: &str = "robot = \"arm.toml\"\n\n[sensors]\n\
    effort_noise_nm = { shoulder = 0.1, elbow = 0.1 }\ntime_jitter_ms = 0.1\n";

const SCENARIO: &str = "extends = \"base/sensors.toml\"\nseed = 3\n\n[[effect]]\n\
    coulomb_friction = { joint = \"elbow\", level_nm = 0.6 }\n\n[[run]]\nname = \"waves\"\n\
    motion.sinusoids = { seed = 1, terms = 3, lowest_hz = 0.2, highest_hz = 1, duration_s = 4 }\n\n\
    [[run]]\nname = \"recorded\"\nmotion.recorded = { file = \"good.csv\" }\n";

/// A folder with the arm, a scenario that extends another and follows a log.
fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    fs::create_dir(path.join("base")).unwrap();
    arm::write(path, "base/arm.urdf", arm::URDF);
    arm::write(path, "base/arm.toml", ROBOT);
    arm::write(path, "base/sensors.toml", SENSORS);
    arm::write(path, "good.csv", &first_seconds(&arm::log(0, arm::Gap::None), 4.0));
    arm::write(path, "scenario.toml", SCENARIO);
    folder
}

fn first_seconds(log: &str, duration_s: f64) -> String {
    let time = |line: &str| line.split(',').next().and_then(|t| t.parse().ok()).unwrap_or(0.0);
    let kept = log.lines().filter(|line| time(line) <= duration_s);
    kept.flat_map(|line| [line, "\n"]).collect()
}

fn simulate(folder: &Path, more: &[&str]) -> Answer {
    run(folder, &[&["simulate", "scenario.toml", "--out", "out"], more].concat())
}

/// Every file of a folder, by name.
fn files(folder: &Path) -> Vec<(String, Vec<u8>)> {
    let entries = fs::read_dir(folder).unwrap().map(|e| e.unwrap().path());
    let name = |p: &PathBuf| p.file_name().unwrap().to_str().unwrap().to_owned();
    let mut files: Vec<_> = entries.map(|p| (name(&p), fs::read(&p).unwrap())).collect();
    files.sort();
    files
}

fn names(files: &[(String, Vec<u8>)]) -> Vec<&str> {
    files.iter().map(|(name, _)| name.as_str()).collect()
}

#[test]
fn the_schema_among_the_scenarios_is_that_of_the_program() {
    let kinds = [
        ("simulate", "scenario", ["differential_coupling", "torque_share"]),
        ("track", "tracking", ["gp-rbd-prior", "stops_at_s"]),
    ];
    for (command, name, words) in kinds {
        let answer = run(&workspace(), &["schema", command]);
        let file = format!("scenarios/schemas/{name}.schema.json");
        let stale = format!("stale: cargo run --release -- schema {command} > {file}");
        assert!(fs::read_to_string(workspace().join(&file)).unwrap() == answer.out, "{stale}");
        for expected in words.iter().chain(&["extends"]) {
            assert!(answer.out.contains(&format!("\"{expected}\"")), "{expected} is missing");
        }
        assert!(!answer.out.contains("\n  \"required\""), "what is extended may say it");
    }
}

/// Files below a folder that end so.
fn below(folder: &Path, ending: &str, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            below(&path, ending, found);
        } else if path.extension().is_some_and(|e| e == ending) {
            found.push(path);
        }
    }
}

/// The schemas as a scenario in its folder sees them.
const SCHEMAS: &str = "../schemas";

/// A scenario of runs without any is there to be extended: it is tried with a run added.
#[test]
fn every_scenario_is_accepted_and_names_the_schema_in_its_first_line() {
    let scenarios = workspace().join("scenarios");
    let mut found = Vec::new();
    below(&scenarios, "toml", &mut found);
    let (mut tracked, mut others) = (0, 0);
    for path in &found {
        let text = fs::read_to_string(path).unwrap();
        let first = text.lines().next().unwrap();
        let mut document = Document::read(path).unwrap();
        if first == format!("#:schema {SCHEMAS}/tracking.schema.json") {
            let scenario = TrackingScenario::from_document(&document);
            assert!(scenario.is_ok(), "{}: {}", path.display(), scenario.err().unwrap());
            tracked += 1;
            continue;
        }
        if ["trials", "figure"].iter().any(|name| first.ends_with(&format!("{name}.schema.json"))) {
            others += 1;
            continue;
        }
        assert_eq!(first, format!("#:schema {SCHEMAS}/scenario.schema.json"), "{}", path.display());
        if !document.to_toml().contains("[[run]]") {
            document.set("run=[{ name = 'x', motion = { hold = { duration_s = 1 } } }]").unwrap();
        }
        let scenario = Scenario::from_document(&document);
        assert!(scenario.is_ok(), "{}: {}", path.display(), scenario.err().unwrap());
    }
    let counts = [tracked, others, found.len() - tracked - others];
    assert!(counts.iter().all(|&count| count > 0), "{counts:?}");
}

/// Refused with exit code 3 and this text, before anything is written.
fn refused(change: impl Fn(&str) -> String, more: &[&str], expected: &str) {
    let folder = folder();
    arm::write(folder.path(), "scenario.toml", &change(SCENARIO));
    let answer = simulate(folder.path(), more);
    assert_eq!((answer.code, answer.out.as_str()), (3, ""), "{}", answer.err);
    assert_eq!(answer.err.trim_end(), expected.trim_matches('\n'));
    assert!(!folder.path().join("out").exists());
}

#[test]
fn a_misspelt_joint_is_underlined() {
    refused(
        |s| s.replace("\"elbow\"", "\"elbwo\""),
        &[],
        r#"
error: no joint of robot arm is called elbwo, did you mean elbow?
 --> scenario.toml:5:30
  |
5 | coulomb_friction = { joint = "elbwo", level_nm = 0.6 }
  |                              ^^^^^^^ effect.0.coulomb_friction.joint"#,
    );
}

#[test]
fn a_misspelt_key_is_underlined_and_the_known_ones_are_told() {
    refused(
        |s| s.replace("level_nm", "level"),
        &[],
        r#"
error: unknown key `level`, did you mean `level_nm`?
 --> scenario.toml:5:39
  |
5 | coulomb_friction = { joint = "elbow", level = 0.6 }
  |                                       ^^^^^ effect.0.coulomb_friction.level
  |
  = help: expected `joint` or `level_nm`"#,
    );
}

#[test]
fn a_value_that_no_arm_has_is_underlined_on_the_command_line() {
    refused(
        str::to_owned,
        &["--set", "effect.0.coulomb_friction.level_nm=-0.6"],
        r"
error: -0.6, a number from 0 to 1000 was expected
  |
1 | --set effect.0.coulomb_friction.level_nm=-0.6
  |                                          ^^^^ effect.0.coulomb_friction.level_nm",
    );
}

#[test]
fn a_motion_beyond_the_limits_is_underlined() {
    refused(
        |s| {
            s.replace(
                "recorded = { file = \"good.csv\" }",
                "ramp = { to_rad.elbow = 3, duration_s = 4 }",
            )
        },
        &[],
        r"
error: ramp: joint elbow reaches a position of 3.000000 rad at 4.000 s, -2.9 to 2.9 rad was expected (the robot's limits)
  --> scenario.toml:13:15
   |
13 | motion.ramp = { to_rad.elbow = 3, duration_s = 4 }
   |               ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ run.1.motion.ramp",
    );
}

#[test]
fn a_step_that_does_not_divide_the_period_is_underlined_where_it_stands() {
    let folder = folder();
    arm::write(
        folder.path(),
        "base/sensors.toml",
        &format!("{SENSORS}\n[engine]\nstep_ms = 0.3\n"),
    );
    let answer = simulate(folder.path(), &[]);
    assert_eq!(answer.code, 3);
    for part in ["base/sensors.toml:8:11", "step_ms = 0.3", "^^^ engine.step_ms"] {
        assert!(answer.err.contains(part), "{part} is missing in\n{}", answer.err);
    }
}

#[test]
fn the_logs_the_scenario_and_the_truth_are_written_and_told() {
    let folder = folder();
    let answer = simulate(folder.path(), &[]);
    assert_eq!((answer.code, answer.err.as_str()), (0, ""));
    let expected = "  run       rows  seconds  log\n  \
        waves     2001      4.0  out/waves.parquet\n  \
        recorded  2766      5.5  out/recorded.parquet\n\n\
        What was put in stands in out/truth.json, for scoring only. To diagnose the logs:\n  \
        plumbline diagnose --robot base/arm.toml --log out/waves.parquet out/recorded.parquet --out out/diagnosis\n";
    assert_eq!(answer.out, expected);
    let written = files(&folder.path().join("out"));
    assert_eq!(
        names(&written),
        ["recorded.parquet", "scenario.toml", "truth.json", "waves.parquet"]
    );
    let truth = &fs::read_to_string(folder.path().join("out/truth.json")).unwrap();
    let truth: serde_json::Value = serde_json::from_str(truth).unwrap();
    let effect = &truth["effects"][0];
    assert_eq!((&truth["seed"], &effect["effect"]), (&3.into(), &"coulomb_friction".into()));
    assert_eq!(effect["code"], "FR02");
    assert_eq!(effect["parameters"]["level"], 0.6);
    let quiet = simulate(folder.path(), &["--csv", "--quiet"]);
    assert_eq!((quiet.code, quiet.out.as_str(), quiet.err.as_str()), (0, "", ""));
    assert!(folder.path().join("out/waves.csv").exists());
}

#[test]
fn the_resolved_scenario_gives_the_same_bytes_from_anywhere_on_any_number_of_threads() {
    let folder = folder();
    let hidden = "hidden={ count = [1, 1], from = ['viscous_friction', 'coulomb_friction'] }";
    let answer = simulate(folder.path(), &["--set", hidden, "--set", "sensors.dropped_share=0.1"]);
    assert_eq!(answer.code, 0, "{}", answer.err);
    let first = files(&folder.path().join("out"));

    let elsewhere = tempfile::tempdir().unwrap();
    fs::copy(folder.path().join("out/scenario.toml"), elsewhere.path().join("s.toml")).unwrap();
    let again = |threads: &str, more: &[&str]| {
        let mut command = plumbline();
        command.current_dir(elsewhere.path()).env("RAYON_NUM_THREADS", threads);
        command.args(["simulate", "s.toml", "--out", "again", "--quiet"]).args(more);
        let answer: Answer = command.output().unwrap().into();
        assert_eq!(answer.code, 0, "{}", answer.err);
        files(&elsewhere.path().join("again"))
    };
    for (threads, more) in [("1", &[][..]), ("4", &[]), ("2", &["--seed", "3"])] {
        let again = again(threads, more);
        assert_eq!(names(&again), names(&first));
        for ((name, bytes), (_, before)) in again.iter().zip(&first) {
            assert!(bytes == before, "{name} differs on {threads} threads with {more:?}");
        }
    }
    let other = again("2", &["--seed", "4"]);
    for ((name, bytes), (_, before)) in other.iter().zip(&first) {
        assert!(bytes != before, "{name} is the same with another seed");
    }
}

#[test]
fn seeds_are_those_that_a_scenario_can_hold() {
    let folder = folder();
    let answer = simulate(folder.path(), &["--seed", "9223372036854775807", "--quiet"]);
    assert_eq!(answer.code, 0, "{}", answer.err);
    let answer = simulate(folder.path(), &["--seed", "9223372036854775808"]);
    assert_eq!(answer.code, 2);
    assert!(answer.err.contains("9223372036854775808 is not in 0..=9223372036854775807"));
}

/// Ends with exit code 3 and all of `expected`; the logs of before are untouched. The motors of
/// this arm have no limits of torque.
fn ends(more: &[&str], expected: &[&str]) {
    let folder = folder();
    let strong = arm::URDF.replace("effort=\"40\"", "effort=\"1e9\"");
    arm::write(folder.path(), "base/arm.urdf", &strong.replace("effort=\"80\"", "effort=\"1e9\""));
    fs::create_dir(folder.path().join("out")).unwrap();
    arm::write(folder.path(), "out/waves.parquet", "of yesterday");
    let answer = simulate(folder.path(), more);
    assert_eq!((answer.code, answer.out.as_str()), (3, ""), "{}", answer.err);
    assert_eq!(answer.err.lines().count(), 1, "{}", answer.err);
    for part in expected {
        assert!(answer.err.contains(part), "{part} is missing in\n{}", answer.err);
    }
    let left = files(&folder.path().join("out"));
    assert_eq!(left, [("waves.parquet".to_owned(), b"of yesterday".to_vec())]);
}

#[test]
fn a_joint_that_runs_away_ends_with_time_joint_value_and_advice() {
    let gains = "control.kd_nm_s_per_rad={ shoulder = 20000, elbow = 5000 }";
    let expected = ["error: run ", "joint ", " s: its speed is ", " rad/s", "lower the gains"];
    ends(&["--set", gains], &expected);
}

#[test]
fn a_spring_that_is_too_stiff_for_the_step_is_refused_with_the_step_that_would_do() {
    let spring =
        "effect=[{ cable_spring = { joint = 'elbow', stiffness_nm_per_rad = 1e5, rest_rad = 0 } }]";
    let step = "engine.step_ms=0.5";
    let expected =
        ["joint elbow: a stiffness of ", "steps of 0.5 ms", "set engine.step_ms to at most 0."];
    ends(&["--set", spring, "--set", step], &expected);
}

#[test]
fn what_cannot_be_drawn_is_said() {
    let hidden =
        "hidden={ count = [1, 1], from = ['encoder_offset'], torque_share = [0.95, 0.96] }";
    ends(
        &[
            "--set",
            hidden,
            "--set",
            "run=[{ name = 'x', lead_in_s = 0, motion = { hold = { duration_s = 0.2 } } }]",
        ],
        &["none of 40 draws", "between 0.95 and 0.96", "SE01 encoder_offset at "],
    );
}

/// Killed as soon as the first log is there: every file with the name of a log is whole.
#[test]
fn a_run_that_is_killed_leaves_no_half_log() {
    let folder = folder();
    let run = |i: usize| format!("[[run]]\nname = \"run_{i}\"\nmotion.hold.duration_s = 0.4\n");
    let runs: String = (0..60).map(run).collect();
    let scenario = format!("extends = \"base/sensors.toml\"\ncontrol.rate_hz = 2000\n{runs}");
    arm::write(folder.path(), "scenario.toml", &scenario);
    let out = folder.path().join("out");
    fs::create_dir(&out).unwrap();
    arm::write(&out, "truth.json", "of yesterday");
    let mut command = plumbline();
    command.current_dir(folder.path()).args(["simulate", "scenario.toml", "--out", "out"]);
    let mut child = command.args(["--csv"]).spawn().unwrap();
    let start = Instant::now();
    let patience = Duration::from_secs(60);
    while !out.join("run_0.csv").exists() && start.elapsed() < patience {
        sleep(Duration::from_micros(200));
    }
    child.kill().unwrap();
    child.wait().unwrap();
    let left = files(&out);
    let (logs, others): (Vec<_>, Vec<_>) = left.iter().partition(|(name, _)| name.ends_with("csv"));
    assert!(!logs.is_empty() && logs.len() < 60, "{} logs", logs.len());
    for (name, bytes) in logs {
        let lines = String::from_utf8(bytes.clone()).unwrap().lines().count();
        assert!(bytes.ends_with(b"\n") && lines == 802, "{name} has {lines} lines");
    }
    for (name, _) in others {
        assert!(name.starts_with(".plumbline-") && !name.contains("csv"), "{name}");
    }
}

#[test]
fn help_says_what_is_written_and_the_exit_codes_of_a_simulation() {
    let folder = tempfile::tempdir().unwrap();
    for command in ["simulate", "replay"] {
        let help = run(folder.path(), &[command, "--help"]);
        assert_eq!(help.code, 0);
        for expected in
            ["Examples:", "The output folder holds", "  3  a scenario, a robot or a log"]
        {
            assert!(help.out.contains(expected), "{expected} is missing in\n{}", help.out);
        }
        assert!(help.out.lines().all(|line| line.chars().count() <= 100), "{}", help.out);
    }
}
